#include "particle_surface_tracker/stages/disagreement.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <Eigen/Geometry>

#include "matching_cases.h"
#include "particle_surface_tracker/tracker/tracker.h"
#include "support/detailed_body.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test::matching {
namespace {

const Body kBody = ball({0.02, 0.01, 0.03}, 0.9);

/// Disagreement of a mesh, with the same δ everywhere, and a body.
Disagreement find(const TriangleMesh& mesh, const Body& body, double delta = 0.0, double dx = kH) {
  const MeshLattice lattice(mesh.positions(), mesh.triangles(), kH);
  const std::vector<float> deltas(mesh.vertex_count(), static_cast<float>(delta));
  const ImplicitSurface surface = make_surface(body, dx);
  return find_disagreement(MeshQuery(lattice), deltas, IsosurfaceQuery(surface, lattice.h()), make_parameters());
}

/// All nodes of the disagreement are on the inner side of a body, or just outside, and there are some.
void expect_within(const Disagreement& found, const Body& body) {
  EXPECT_FALSE(found.nodes.empty());
  for (const openvdb::Coord& node : found.nodes) EXPECT_LT(body(place(node)), 0.5 * kH) << node;
}

TEST(Disagreement, NothingWhereMeshAndIsosurfaceAgree) {
  const Disagreement found = find(make_mesh(kBody), kBody);
  EXPECT_TRUE(found.nodes.empty());
  EXPECT_TRUE(found.flagged_cells.empty());
}

TEST(Disagreement, SeesADropBornAwayFromTheMesh) {
  const Body drop = ball({1.2, 1.1, 1.0}, 0.15);
  expect_within(find(make_mesh(kBody), either(kBody, drop)), drop);
  expect_within(find(make_mesh(kBody), either(kBody, drop), 0.0, 0.7 * kH), drop);
}

TEST(Disagreement, SeesABubbleBornInsideTheMesh) {
  const Body bubble = ball({0.1, -0.2, 0.1}, 0.15);
  const Disagreement found = find(make_mesh(kBody), without(kBody, bubble));
  expect_within(found, bubble);
}

TEST(Disagreement, SeesLiquidWithoutAnyMesh) {
  expect_within(find(TriangleMesh(), kBody), kBody);
}

TEST(Disagreement, SeesAHoleInsideTwoLargeTriangles) {
  // A plate of two triangles on each side; no vertex is near the hole.
  const TriangleMesh plate = make_box({-1.5, -1.5, -0.1}, {1.5, 1.5, 0.1});
  const Body whole = [](const Vec3d& p) {
    return std::max({std::abs(p.x()) - 1.5, std::abs(p.y()) - 1.5, std::abs(p.z()) - 0.1});
  };
  const Body hole = capsule({0.2, 0.1, -1}, {0.2, 0.1, 1}, 0.2);
  EXPECT_TRUE(find(plate, whole).nodes.empty());
  expect_within(find(plate, without(whole, hole)), hole);
}

TEST(Disagreement, SeesAMeshThatNothingHolds) {
  // Its few vertices are far apart; those of fine meshes are flagged because their projection fails or jumps.
  const TriangleMesh box = make_box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5});
  const Body elsewhere = ball({1.4, 1.4, 1.4}, 0.3);
  const Disagreement found = find(box, elsewhere);
  std::size_t at_box = 0;
  for (const openvdb::Coord& node : found.nodes) at_box += place(node).cwiseAbs().maxCoeff() < 0.6 ? 1 : 0;
  EXPECT_GT(at_box, 100u);
  EXPECT_LT(at_box, found.nodes.size()) << "the drop elsewhere has no mesh";
}

TEST(Disagreement, DeltaExplainsWhatTheMeshHasThere) {
  // The mesh lies two cells outside a drop: without δ that is another drop.
  const Body drop = ball({0.01, 0.02, 0.0}, 0.3);
  const Body around = [&](const Vec3d& p) { return drop(p) - 2.2 * kH; };
  EXPECT_TRUE(find(make_mesh(around), drop, 2.2 * kH).nodes.empty());
  EXPECT_FALSE(find(make_mesh(around), drop, 0.0).nodes.empty());
}

TEST(Disagreement, FlagsTheEightCellsAroundEachNode) {
  const Disagreement found = find(make_mesh(kBody), either(kBody, ball({1.2, 1.1, 1.0}, 0.15)));
  Nodes cells;
  for (const openvdb::Coord& node : found.nodes) {
    for (int c = 0; c < 8; ++c) cells.insert(node.offsetBy(-(c & 1), -(c >> 1 & 1), -(c >> 2)));
  }
  EXPECT_EQ(found.flagged_cells, std::vector<openvdb::Coord>(cells.begin(), cells.end()));
  EXPECT_TRUE(std::is_sorted(found.nodes.begin(), found.nodes.end()));
}

TEST(Disagreement, IsOffWhereOnlyTauCounts) {
  Parameters parameters = make_parameters();
  parameters.detection = DetectionMethod::kTau;
  const TriangleMesh none;
  const MeshLattice lattice(none.positions(), none.triangles(), kH);
  const ImplicitSurface surface = make_surface(kBody);
  EXPECT_TRUE(find_disagreement(MeshQuery(lattice), {}, IsosurfaceQuery(surface, kH), parameters).nodes.empty());
}

TEST(Disagreement, IsTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = make_mesh(kBody);
  const Body bubbles = without(without(kBody, ball({0.1, -0.2, 0.1}, 0.2)), ball({0.2, 0.4, 0.1}, 0.15));
  std::vector<Disagreement> results;
  for (const std::size_t threads : {1u, 2u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(find(mesh, bubbles));
  }
  EXPECT_FALSE(results[0].nodes.empty());
  EXPECT_EQ(results[0].nodes, results[1].nodes);
  EXPECT_EQ(results[0].flagged_cells, results[1].flagged_cells);
}

TEST(Disagreement, ARigidMotionOfADetailedBodyFlagsNothing) {
  // Spikes, fins and handles of one to two r thickness, which hold few particles or none.
  const DetailedBody body(kR);
  Parameters parameters = make_parameters();
  const ParticleFrame first = body.particles(0.2);
  Tracker tracker(parameters);
  tracker.start(body.mesh(), first);
  for (int n = 1; n <= 5; ++n) {
    const Eigen::AngleAxisd turn(0.03 * n, Vec3d(1, 2, -1).normalized());
    ParticleFrame frame = first;
    for (Vec3f& p : frame.positions) {
      p = (turn * (p.cast<double>() - body.center()) + body.center() + Vec3d(0.3, 0.2, 0.1) * (kR * n)).cast<float>();
    }
    tracker.advance(frame, static_cast<std::uint64_t>(n));
    EXPECT_TRUE(tracker.detection().flagged_cells.empty());
    const TriangleMesh& mesh = tracker.mesh();
    const MeshLattice lattice(mesh.positions(), mesh.triangles(), kH);
    const IsosurfaceQuery isosurface(*tracker.implicit_surface(), lattice.h());
    const Disagreement found = find_disagreement(MeshQuery(lattice), mesh.delta(), isosurface, parameters);
    EXPECT_TRUE(found.nodes.empty()) << "frame " << n << ": " << found.nodes.size() << " nodes";
  }
}

}  // namespace
}  // namespace particle_surface_tracker::test::matching
