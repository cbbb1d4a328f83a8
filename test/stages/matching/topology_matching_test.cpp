#include "particle_surface_tracker/stages/topology_matching.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "matching_cases.h"
#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker::test::matching {
namespace {

/// A mesh, the isosurface it is to be matched to, and what is flagged.
struct Case {
  TriangleMesh mesh;
  ImplicitSurface surface;
  std::vector<openvdb::Coord> flagged;
  MeshLattice lattice;

  Case(const Body& before, const Body& after, const std::function<bool(const Vec3d&)>& flag)
      : mesh(make_mesh(before)),
        surface(make_surface(after)),
        flagged(cells_where(mesh, flag)),
        lattice(mesh.positions(), mesh.triangles(), kH) {}

  MatchedVoxelization match(const Parameters& parameters) const {
    return match_topology(MeshQuery(lattice), IsosurfaceQuery(surface, kH), flagged, parameters);
  }
};

const Body kLeft = ball({-0.52, 0.01, 0.02}, 0.45);
const Body kRight = ball({0.51, 0.0, 0.01}, 0.45);
const Body kNeck = capsule({-0.4, 0, 0}, {0.4, 0, 0}, 0.16);

/// Two balls that a neck joins, or that it joined before.
Case joining_balls() {
  return {either(kLeft, kRight), either(either(kLeft, kRight), kNeck), [](const Vec3d& p) { return kNeck(p) < -0.02; }};
}

Case parting_balls() {
  return {either(either(kLeft, kRight), kNeck), either(kLeft, kRight),
          [](const Vec3d& p) { return std::min(kLeft(p), kRight(p)) > 0.02; }};
}

Parameters with(const std::string& name, const std::string& value, Parameters parameters = make_parameters()) {
  set_parameter(parameters, name, value);
  return parameters;
}

TEST(TopologyMatching, WithoutFlagsNothingIsDone) {
  const Case balls = joining_balls();
  const MatchedVoxelization matched =
      match_topology(MeshQuery(balls.lattice), IsosurfaceQuery(balls.surface, kH), {}, make_parameters());
  EXPECT_TRUE(matched.nodes.empty());
  EXPECT_TRUE(matched.changed.empty());
  EXPECT_EQ(matched.statistics.unknowns, 0u);
}

TEST(TopologyMatching, BallsThatPhiJoinsBecomeOne) {
  for (const char* solver : {"sor", "pcg"}) {
    const Case balls = joining_balls();
    ASSERT_FALSE(balls.flagged.empty());
    const MatchedVoxelization matched = balls.match(with("matching_solver", solver));
    EXPECT_EQ(count_components(nodes_inside(balls.lattice, {})), 2);
    EXPECT_EQ(count_components(nodes_inside(balls.lattice, matched)), 1);
    EXPECT_TRUE(matched.statistics.converged);
    EXPECT_FALSE(matched.changed.empty());
    // Only the neck was added: the mesh is φ elsewhere, up to how both are sampled.
    for (const openvdb::Coord& node : matched.changed) EXPECT_LT(kNeck(place(node)), 0.5 * kH) << node;
  }
}

TEST(TopologyMatching, BallsThatPhiPartsBecomeTwo) {
  for (const char* solver : {"sor", "pcg"}) {
    const Case balls = parting_balls();
    const MatchedVoxelization matched = balls.match(with("matching_solver", solver));
    EXPECT_EQ(count_components(nodes_inside(balls.lattice, {})), 1);
    EXPECT_EQ(count_components(nodes_inside(balls.lattice, matched)), 2);
    for (const openvdb::Coord& node : matched.changed) EXPECT_LT(kNeck(place(node)), 0.5 * kH) << node;
  }
}

TEST(TopologyMatching, ChangedAreTheNodesWhoseSideDiffersAndNodesAreSorted) {
  const Case balls = joining_balls();
  const MatchedVoxelization matched = balls.match(make_parameters());
  ASSERT_EQ(matched.nodes.size(), matched.gamma.size());
  EXPECT_EQ(matched.statistics.unknowns, matched.nodes.size());
  std::vector<openvdb::Coord> changed;
  for (std::size_t n = 0; n < matched.nodes.size(); ++n) {
    if (n > 0) {
      ASSERT_LT(matched.nodes[n - 1], matched.nodes[n]);
    }
    if ((balls.lattice.winding_number(matched.nodes[n]) >= 1) != (matched.gamma[n] < 0.0f)) {
      changed.push_back(matched.nodes[n]);
    }
  }
  EXPECT_EQ(matched.changed, changed);
}

TEST(TopologyMatching, TheMeshesDetailIsBlendedIn) {
  // The mesh lies 1.5 cells outside φ everywhere, and so does what is made at the neck.
  const double offset = 1.5 * kH;
  const auto grown = [&](const Body& body) -> Body { return [=](const Vec3d& p) { return body(p) - offset; }; };
  const Body apart = either(ball({-0.7, 0, 0}, 0.4), ball({0.7, 0, 0}, 0.4));
  const Body neck = capsule({-0.7, 0, 0}, {0.7, 0, 0}, 0.25);
  const Case balls(grown(apart), either(apart, neck), [&](const Vec3d& p) { return neck(p) < 0.3 * kH + offset; });
  const MatchedVoxelization matched = balls.match(make_parameters());
  const Nodes inside = nodes_inside(balls.lattice, matched);
  EXPECT_EQ(count_components(inside), 1);
  for (int y = 0; y <= kHalfWidth; ++y) {
    const Vec3d p = place({0, y, 0});
    if (std::abs(neck(p) - offset) < 0.5 * kH) continue;
    EXPECT_EQ(inside.count({0, y, 0}) == 1, neck(p) < offset) << "y " << p.y();
  }
}

TEST(TopologyMatching, AMeshThatNothingHoldsVanishesAndTheOtherStays) {
  const Case balls(either(kLeft, kRight), kLeft, [](const Vec3d& p) { return kRight(p) < 0.1; });
  const MatchedVoxelization matched = balls.match(make_parameters());
  const Nodes before = nodes_inside(balls.lattice, {});
  const Nodes after = nodes_inside(balls.lattice, matched);
  for (const openvdb::Coord& node : before) EXPECT_EQ(after.count(node) == 1, kLeft(place(node)) < 0.1) << node;
  EXPECT_EQ(count_components(after), 1);
}

TEST(TopologyMatching, WhereNoFixedNodeIsGammaIsPhi) {
  const Body drop = ball({1.2, 1.1, 1.0}, 0.2);
  const Case birth(kLeft, either(kLeft, drop), [](const Vec3d&) { return false; });
  std::vector<openvdb::Coord> at_drop;
  for (const openvdb::Coord& node : nodes_inside(drop)) at_drop.push_back(node);
  const MatchedVoxelization matched =
      match_topology(MeshQuery(birth.lattice), IsosurfaceQuery(birth.surface, kH), at_drop, make_parameters());
  EXPECT_EQ(matched.statistics.fixed, 0u);
  EXPECT_EQ(matched.statistics.free_unknowns, matched.nodes.size());
  EXPECT_EQ(matched.changed, at_drop) << "flagged were exactly the drop's nodes, sorted";
  for (std::size_t n = 0; n < matched.nodes.size(); ++n) {
    const double distance = drop(place(matched.nodes[n]));
    if (std::abs(distance) < 1.5 * kH) {
      EXPECT_NEAR(matched.gamma[n], distance, 0.2 * kH) << matched.nodes[n];
    }
  }
}

TEST(TopologyMatching, AMeshCanBeginWithNothing) {
  const Body drop = ball({0.1, 0.2, 0.3}, 0.5);
  const ImplicitSurface surface = make_surface(drop);
  const std::vector<Vec3f> positions;
  const std::vector<Triangle> triangles;
  const MeshLattice lattice(positions, triangles, kH);
  const MatchedVoxelization matched =
      match_topology(MeshQuery(lattice), IsosurfaceQuery(surface, kH), {{7, 4, 6}}, make_parameters());
  EXPECT_EQ(nodes_inside(lattice, matched), nodes_inside(drop)) << "the region has to grow over the whole drop";
  EXPECT_GT(matched.statistics.enlargements, 0);
}

TEST(TopologyMatching, TheRegionGrowsWhereASideChangesAtItsRim) {
  // One end of a long bubble is flagged.
  const Body bubble = capsule({-0.7, 0, 0}, {0.7, 0, 0}, 0.12);
  const Body block = ball({0, 0, 0}, 1.3);
  const Case born(block, without(block, bubble), [](const Vec3d&) { return false; });
  const MatchedVoxelization matched =
      match_topology(MeshQuery(born.lattice), IsosurfaceQuery(born.surface, kH), {{-14, 0, 0}}, make_parameters());
  EXPECT_GT(matched.statistics.enlargements, 0);
  EXPECT_EQ(Nodes(matched.changed.begin(), matched.changed.end()), nodes_inside(bubble));
}

TEST(TopologyMatching, NodesInAnOverlapAreNotFixed) {
  // Two balls overlap, so that sheets of the mesh are inside the other's ball: no false cavity opens there.
  const Body left = ball({-0.3, 0, 0}, 0.5);
  const Body right = ball({0.3, 0.01, 0}, 0.5);
  std::vector<Vec3f> positions;
  std::vector<Triangle> triangles;
  for (const Body& body : {left, right}) {
    const TriangleMesh mesh = make_mesh(body);
    const auto first = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), mesh.positions().begin(), mesh.positions().end());
    for (const Triangle& t : mesh.triangles()) triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  const MeshLattice lattice(positions, triangles, kH);
  const ImplicitSurface surface = make_surface(either(left, right));
  const MatchedVoxelization matched =
      match_topology(MeshQuery(lattice), IsosurfaceQuery(surface, kH), {{0, 8, 0}}, make_parameters());
  EXPECT_TRUE(matched.changed.empty()) << matched.changed.size();
  for (std::size_t n = 0; n < matched.nodes.size(); ++n) {
    const Vec3d p = place(matched.nodes[n]);
    if (std::min(left(p), right(p)) < -kH) {
      EXPECT_LT(matched.gamma[n], 0.0f) << matched.nodes[n];
    }
  }
}

TEST(TopologyMatching, AReachThatIsLargeEnoughGivesWhatTheWholeDomainGives) {
  for (const Case& balls : {joining_balls(), parting_balls()}) {
    const MatchedVoxelization near = balls.match(make_parameters());
    const MatchedVoxelization whole = balls.match(with("matching_reach", "0"));
    EXPECT_GT(whole.nodes.size(), near.nodes.size());
    EXPECT_EQ(count_components(nodes_inside(balls.lattice, near)),
              count_components(nodes_inside(balls.lattice, whole)));
    // ψ may differ a little; then so does the side of nodes that Γ's zero passes through, and of no others.
    std::vector<openvdb::Coord> differing;
    std::set_symmetric_difference(near.changed.begin(), near.changed.end(), whole.changed.begin(), whole.changed.end(),
                                  std::back_inserter(differing));
    for (const openvdb::Coord& node : differing) {
      const auto at = std::lower_bound(whole.nodes.begin(), whole.nodes.end(), node) - whole.nodes.begin();
      EXPECT_LT(std::abs(whole.gamma[static_cast<std::size_t>(at)]), 0.02 * kH) << node;
    }
    EXPECT_LT(differing.size(), 3u);
  }
}

TEST(TopologyMatching, InEveryFrameItFindsWhatWasNotFlagged) {
  const Body bubble = ball({-0.52, 0.01, 0.02}, 0.15);
  const Case born(either(kLeft, kRight), without(either(kLeft, kRight), bubble), [](const Vec3d&) { return false; });
  const MatchedVoxelization matched = born.match(with("matching_frames", "every"));
  // Mesh and φ are sampled differently, so that Γ = φ + ψ has its zero a few hundredths of a cell away from φ's.
  const Nodes changed(matched.changed.begin(), matched.changed.end());
  for (const openvdb::Coord& node : nodes_inside(bubble))
    EXPECT_TRUE(changed.count(node) || bubble(place(node)) > -0.1 * kH);
  for (const openvdb::Coord& node : changed) EXPECT_LT(bubble(place(node)), 0.1 * kH);
  EXPECT_FALSE(changed.empty());
  EXPECT_EQ(matched.statistics.flagged_nodes, 0u);
}

TEST(TopologyMatching, SorStoppedAtBetaHasStepsBelowBeta) {
  const Case balls = joining_balls();
  const MatchedVoxelization sor = balls.match(with("matching_solver", "sor"));
  const MatchedVoxelization pcg = balls.match(with("matching_solver", "pcg"));
  EXPECT_LT(sor.statistics.residual, 0.01 * kH);
  EXPECT_LT(pcg.statistics.residual, 1e-6 * kH);
  EXPECT_EQ(sor.nodes, pcg.nodes);
  const MatchedVoxelization exact = balls.match(with("beta", "1e-5", with("matching_solver", "sor")));
  for (std::size_t n = 0; n < exact.nodes.size(); ++n) EXPECT_NEAR(exact.gamma[n], pcg.gamma[n], 0.01 * kH);
}

TEST(TopologyMatching, IsTheSameForAnyNumberOfThreads) {
  const Case balls = joining_balls();
  for (const char* solver : {"sor", "pcg"}) {
    std::vector<MatchedVoxelization> results;
    for (const std::size_t threads : {1u, 2u}) {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      results.push_back(balls.match(with("matching_solver", solver)));
    }
    EXPECT_EQ(results[0].nodes, results[1].nodes);
    EXPECT_EQ(results[0].changed, results[1].changed);
    ASSERT_EQ(results[0].gamma.size(), results[1].gamma.size());
    EXPECT_EQ(std::memcmp(results[0].gamma.data(), results[1].gamma.data(), 4 * results[0].gamma.size()), 0);
  }
}

TEST(TopologyMatching, AWholeDomainThatIsTooLargeIsAnError) {
  std::vector<Vec3f> positions;
  std::vector<Triangle> triangles;
  for (const float x : {0.0f, 1000.0f}) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const Vec3f& p : {Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, 0, 1)}) {
      positions.push_back(p + Vec3f(x, x, x));
    }
    for (const Triangle& t : {Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{0, 3, 2}}) {
      triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
  }
  const MeshLattice lattice(positions, triangles, kH);
  const ImplicitSurface surface = make_surface(ball({0, 0, 0}, 0.3));
  EXPECT_THROW(
      match_topology(MeshQuery(lattice), IsosurfaceQuery(surface, kH), {{0, 0, 0}}, with("matching_reach", "0")),
      TrackingError);
}

}  // namespace
}  // namespace particle_surface_tracker::test::matching
