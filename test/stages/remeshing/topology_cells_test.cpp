// Which cells re-meshing takes for what, against a search of everything by everything.

#include <gtest/gtest.h>

#include "cell_reference.h"
#include "particle_surface_tracker/stages/remeshing.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using openvdb::Coord;

constexpr double kH = 0.125;

/// Nothing lies on the lattice, and the spheres have no plane in common.
TriangleMesh overlapping_spheres() {
  return test::joined(
      {test::make_sphere({0.013, 0.027, 0.041}, 0.5, 3), test::make_sphere({0.813, 0.101, 0.067}, 0.47, 3)});
}

TopologyCells cells_of(const TriangleMesh& before, const RemeshingRequest& request) {
  TriangleMesh mesh = before;
  const MeshLattice lattice(before.positions(), before.triangles(), kH);
  TopologyCells cells;
  const RemeshingReport report = remesh(mesh, lattice, request, &cells);
  EXPECT_EQ(report.retries, 0u);
  EXPECT_EQ(cells.complex.size(), report.complex_cells);
  EXPECT_EQ(cells.tangled.size(), report.tangled_cells);
  EXPECT_EQ(cells.deep.size(), report.deep_cells);
  EXPECT_EQ(cells.flagged.size(), report.flagged_cells);
  EXPECT_EQ(cells.changed_nodes.size(), report.changed_nodes);
  EXPECT_EQ(cells.marked.size(), report.remeshed_cells);
  TriangleMesh unrecorded = before;
  remesh(unrecorded, lattice, request);
  EXPECT_EQ(unrecorded.positions(), mesh.positions());
  EXPECT_EQ(unrecorded.triangles(), mesh.triangles());
  return cells;
}

void expect_same_cells(const TopologyCells& cells, const TopologyCells& expected) {
  EXPECT_EQ(cells.cell_size, expected.cell_size);
  EXPECT_EQ(cells.flagged, expected.flagged);
  EXPECT_EQ(cells.complex, expected.complex);
  EXPECT_EQ(cells.tangled, expected.tangled);
  EXPECT_EQ(cells.deep, expected.deep);
  EXPECT_EQ(cells.marked, expected.marked);
  EXPECT_EQ(cells.front, expected.front);
  EXPECT_EQ(cells.changed_nodes, expected.changed_nodes);
}

TEST(TopologyCells, OfOverlappingSpheresAreThoseOfTheReference) {
  const TriangleMesh mesh = overlapping_spheres();
  const TopologyCells cells = cells_of(mesh, {});
  expect_same_cells(cells, test::find_cells_by_force(mesh, kH, {}));
  EXPECT_FALSE(cells.tangled.empty());
  EXPECT_FALSE(cells.front.empty());
}

TEST(TopologyCells, OfFlagsChangedNodesAndThreadsAreThoseOfTheReference) {
  // The thread is thinner than a cell; half a sphere is flagged, and some nodes change sides.
  const TriangleMesh mesh =
      test::joined({overlapping_spheres(), test::make_torus({0.411, 0.883, 0.033}, 0.3, 0.021, 40, 6)});
  RemeshingRequest request;
  for (int x = -5; x < 5; ++x) {
    for (int y = -5; y < 5; ++y) {
      for (int z = -5; z < 0; z += 2) request.flagged_cells.emplace_back(x, y, z);
    }
  }
  request.nodes = {{-4, 0, 0}, {0, 0, 4}, {6, 3, 1}, {9, 0, 0}};
  request.gamma = {-0.01F, 0.01F, -0.02F, 0.02F};
  const TopologyCells cells = cells_of(mesh, request);
  expect_same_cells(cells, test::find_cells_by_force(mesh, kH, request));
  EXPECT_FALSE(cells.deep.empty());
  EXPECT_FALSE(cells.changed_nodes.empty());
  EXPECT_GT(cells.complex.size(), cells.tangled.size());
}

TEST(TopologyCells, AreAllThatSeveralTimesHave) {
  TopologyCells cells;
  cells.marked = {{0, 0, 0}, {2, 0, 0}};
  cells.fixed = {{{0, 0, 0}, {1, 0, 0}}, {1.0F, 2.0F}};
  TopologyCells more;
  more.cell_size = kH;
  more.marked = {{1, 0, 0}, {2, 0, 0}};
  more.fixed = {{{0, 0, 1}, {1, 0, 0}}, {3.0F, 4.0F}};
  cells.add(more);
  EXPECT_EQ(cells.cell_size, kH);
  EXPECT_EQ(cells.marked, (std::vector<Coord>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
  EXPECT_EQ(cells.fixed.nodes, (std::vector<Coord>{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}}));
  EXPECT_EQ(cells.fixed.values, (std::vector<float>{1.0F, 3.0F, 4.0F}));
}

}  // namespace
}  // namespace particle_surface_tracker
