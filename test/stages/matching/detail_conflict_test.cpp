// Where detail and topology cannot both be had.

#include "particle_surface_tracker/stages/detail_conflict.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "stages/matching/liquid_ways.h"
#include "stages/matching/matching_cases.h"

namespace particle_surface_tracker::test::matching {
namespace {

const Body kBody = ball({-0.5, 0.01, 0.02}, 0.5);
const Body kDrop = ball({0.45, 0.01, 0.02}, 0.2);
const Body kNeck = capsule({-0.2, 0.01, 0.02}, {0.4, 0.01, 0.02}, 0.08);

TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
  std::vector<Vec3f> positions = a.positions();
  positions.insert(positions.end(), b.positions().begin(), b.positions().end());
  std::vector<Triangle> triangles = a.triangles();
  for (Triangle t : b.triangles()) {
    for (std::uint32_t& v : t) v += static_cast<std::uint32_t>(a.vertex_count());
    triangles.push_back(t);
  }
  return TriangleMesh(std::move(positions), std::move(triangles));
}

/// A mesh of two pieces whose liquid is joined by a neck.
struct SplitTooEarly {
  TriangleMesh mesh = joined(make_mesh(kBody), make_mesh(kDrop));
  MeshLattice lattice{mesh.positions(), mesh.triangles(), kH};
  ImplicitSurface surface = make_surface(either(either(kBody, kDrop), kNeck));
  IsosurfaceQuery isosurface{surface, kH};
  std::vector<openvdb::Coord> drop_cells = cells_where(mesh, [](const Vec3d& x) { return x.x() > 0.2; });

  int components(const std::vector<openvdb::Coord>& at_conflicts) const {
    const MatchedVoxelization matched =
        match_topology(MeshQuery(lattice), isosurface, {}, make_parameters(), at_conflicts);
    return count_components(nodes_inside(lattice, matched));
  }
};

std::vector<Vec3f> uncovered_in(const TriangleMesh& mesh, const ImplicitSurface& surface, const Vec3f& particle,
                                double reach = kR) {
  const MeshLattice lattice(mesh.positions(), mesh.triangles(), kH);
  const MeshQuery query(lattice);
  const std::vector<Vec3f> uncovered =
      find_uncovered_particles({Vec3f(-0.5F, 0.0F, 0.0F), particle}, query, {}, mesh, reach, make_parameters());
  return near_missing_liquid(uncovered, query, {}, IsosurfaceQuery(surface, kH), make_parameters());
}

TEST(DetailConflict, NoneWithoutPiecesAndParticles) {
  const SplitTooEarly split;
  EXPECT_TRUE(find_conflicting_nodes(MeshQuery(split.lattice), {}, {}, split.isosurface, make_parameters()).empty());
}

TEST(DetailConflict, AScrapIsJoinedToItsBodyAlongTheLiquid) {
  const SplitTooEarly split;
  ASSERT_EQ(split.components({}), 2);
  ComponentDisagreement pieces;
  pieces.scrap_cells = split.drop_cells;
  const auto nodes = find_conflicting_nodes(MeshQuery(split.lattice), pieces, {}, split.isosurface, make_parameters());
  EXPECT_TRUE(std::is_sorted(nodes.begin(), nodes.end()));
  EXPECT_EQ(split.components(nodes), 1);
}

TEST(DetailConflict, ALargePieceIsJoinedByItsNeckAlone) {
  const SplitTooEarly split;
  ComponentDisagreement pieces;
  pieces.stray_cells = split.drop_cells;
  const auto nodes = find_conflicting_nodes(MeshQuery(split.lattice), pieces, {}, split.isosurface, make_parameters());
  EXPECT_EQ(split.components(nodes), 1);
  // What is beyond the middle of the drop keeps its detail.
  for (const openvdb::Coord& node : nodes) EXPECT_LT(place(node).x(), 0.45) << node;
}

// From a node beside the piece a way could lead to the body without joining the piece.
TEST(DetailConflict, WaysBeginInsideAPieceThatHasLiquid) {
  const SplitTooEarly split;
  const MeshQuery query(split.lattice);
  const auto is_in_drop = [](const openvdb::Coord& node) {
    return (place(node) - Vec3d(0.45, 0.01, 0.02)).norm() < 0.2;
  };
  const std::vector<openvdb::Coord> start =
      LiquidWays(query, split.isosurface.field()).nodes_of(split.drop_cells).start;
  EXPECT_FALSE(start.empty());
  EXPECT_TRUE(std::all_of(start.begin(), start.end(), is_in_drop));
  // Liquid that has moved on is beside it.
  const ImplicitSurface elsewhere = make_surface(kBody);
  const IsosurfaceQuery isosurface(elsewhere, kH);
  const std::vector<openvdb::Coord> any = LiquidWays(query, isosurface.field()).nodes_of(split.drop_cells).start;
  EXPECT_TRUE(std::any_of(any.begin(), any.end(), is_in_drop));
  EXPECT_FALSE(std::all_of(any.begin(), any.end(), is_in_drop));
}

TEST(DetailConflict, LiquidThatIsFarAwayIsNotJoined) {
  SplitTooEarly split;
  const ImplicitSurface apart = make_surface(either(kBody, kDrop));
  ComponentDisagreement pieces;
  pieces.stray_cells = split.drop_cells;
  EXPECT_TRUE(
      find_conflicting_nodes(MeshQuery(split.lattice), pieces, {}, IsosurfaceQuery(apart, kH), make_parameters())
          .empty());
}

TEST(DetailConflict, AParticleThatTheMeshLostGetsASurface) {
  const TriangleMesh mesh = make_mesh(kBody);
  const MeshLattice lattice(mesh.positions(), mesh.triangles(), kH);
  const ImplicitSurface surface = make_surface(either(kBody, ball({0.11, 0.01, 0.02}, 0.13)));
  const IsosurfaceQuery isosurface(surface, kH);
  const std::vector<Vec3f> uncovered = uncovered_in(mesh, surface, {0.12F, 0.01F, 0.02F});
  ASSERT_EQ(uncovered.size(), 1U);
  EXPECT_EQ(uncovered.front().x(), 0.12F);
  const auto nodes = find_conflicting_nodes(MeshQuery(lattice), {}, uncovered, isosurface, make_parameters());
  const MatchedVoxelization matched = match_topology(MeshQuery(lattice), isosurface, {}, make_parameters(), nodes);
  const Nodes inside = nodes_inside(lattice, matched);
  EXPECT_EQ(count_components(inside), 1);
  EXPECT_EQ(inside.count({2, 0, 0}), 1U);
}

// The ways are looked for together; each is the one that would be found for its particle alone.
TEST(DetailConflict, ManyParticlesGetWhatEachWouldGet) {
  const TriangleMesh mesh = make_mesh(kBody);
  const MeshLattice lattice(mesh.positions(), mesh.triangles(), kH);
  const ImplicitSurface surface = make_surface(either(either(kBody, kDrop), kNeck));
  const IsosurfaceQuery isosurface(surface, kH);
  std::vector<Vec3f> particles;
  for (int n = 0; n < 14; ++n) particles.emplace_back(0.6F - 0.05F * static_cast<float>(n), 0.01F, 0.02F);
  std::vector<openvdb::Coord> each;
  for (const Vec3f& particle : particles) {
    const auto nodes = find_conflicting_nodes(MeshQuery(lattice), {}, {particle}, isosurface, make_parameters());
    each.insert(each.end(), nodes.begin(), nodes.end());
  }
  std::sort(each.begin(), each.end());
  each.erase(std::unique(each.begin(), each.end()), each.end());
  EXPECT_EQ(find_conflicting_nodes(MeshQuery(lattice), {}, particles, isosurface, make_parameters()), each);
}

TEST(UncoveredParticles, AreOutsideAndFarFromTheMesh) {
  const TriangleMesh mesh = make_mesh(kBody);
  const ImplicitSurface surface = make_surface(either(kBody, ball({0.11, 0.01, 0.02}, 0.13)));
  // The mesh ends at x = 0.
  EXPECT_TRUE(uncovered_in(mesh, surface, {0.12F, 0.01F, 0.02F}, 0.13).empty());
  EXPECT_EQ(uncovered_in(mesh, surface, {0.12F, 0.01F, 0.02F}, 0.11).size(), 1U);
  EXPECT_TRUE(uncovered_in(mesh, surface, {-0.2F, 0.01F, 0.02F}).empty());
}

TEST(UncoveredParticles, CountOnlyWhereTheLiquidIsMissing) {
  const TriangleMesh mesh = make_mesh(kBody);
  EXPECT_TRUE(uncovered_in(mesh, make_surface(kBody), {0.3F, 0.01F, 0.02F}).empty());
}

TEST(UncoveredParticles, AreNotLookedForByTauAlone) {
  const TriangleMesh mesh = make_mesh(kBody);
  const MeshLattice lattice(mesh.positions(), mesh.triangles(), kH);
  Parameters only_tau = make_parameters();
  ASSERT_EQ(find_uncovered_particles({{0.12F, 0.01F, 0.02F}}, MeshQuery(lattice), {}, mesh, kR, only_tau).size(), 1U);
  only_tau.detection = DetectionMethod::kTau;
  EXPECT_TRUE(find_uncovered_particles({{0.12F, 0.01F, 0.02F}}, MeshQuery(lattice), {}, mesh, kR, only_tau).empty());
}

}  // namespace
}  // namespace particle_surface_tracker::test::matching
