#include "particle_surface_tracker/stages/remeshing.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/mesh_measures.h"
#include "sequences/mesh_judge.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using openvdb::Coord;

RemeshingReport remesh_at(TriangleMesh& mesh, double h, const RemeshingRequest& request = {}) {
  const MeshLattice lattice(mesh.positions(), mesh.triangles(), h);
  return remesh(mesh, lattice, request);
}

void expect_sound(const TriangleMesh& mesh) {
  EXPECT_TRUE(test::find_surface_defects(mesh.vertex_count(), mesh.triangles()).none());
}

TEST(Remeshing, LeavesAMeshWithoutComplexCellsAlone) {
  TriangleMesh mesh = test::make_sphere({0.03, -0.02, 0.01}, 1.0, 5);
  const TriangleMesh before = mesh;
  const RemeshingReport report = remesh_at(mesh, 0.1);
  EXPECT_FALSE(report.changed());
  EXPECT_EQ(report.complex_cells, 0u);
  EXPECT_EQ(mesh.positions(), before.positions());
  EXPECT_EQ(mesh.triangles(), before.triangles());
  EXPECT_EQ(mesh.ids(), before.ids());
}

TEST(Remeshing, ExtractsTheWholeMesh) {
  TriangleMesh mesh = test::make_sphere({0.03, -0.02, 0.01}, 1.0, 5);
  const double volume = measure_mesh(mesh.positions(), mesh.triangles()).volume;
  RemeshingRequest request;
  for (int x = -12; x <= 12; ++x) {
    for (int y = -12; y <= 12; ++y) {
      for (int z = -12; z <= 12; ++z) request.flagged_cells.emplace_back(x, y, z);
    }
  }
  const RemeshingReport report = remesh_at(mesh, 0.1, request);
  expect_sound(mesh);
  EXPECT_EQ(report.retries, 0u);
  EXPECT_NEAR(measure_mesh(mesh.positions(), mesh.triangles()).volume, volume, 0.01 * volume);
}

TEST(Remeshing, RemakesSingleCells) {
  const TriangleMesh original = test::make_sphere({0.03, -0.02, 0.01}, 1.0, 5);
  for (int seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    TriangleMesh mesh = original;
    RemeshingRequest request;
    const MeshLattice lattice(mesh.positions(), mesh.triangles(), 0.1);
    const std::vector<Coord> cells = lattice.cells();
    const double share = std::pow(10.0, -3.0 * (seed % 10) / 10.0);
    for (const Coord& cell : cells) {
      if (std::uniform_real_distribution<double>()(random) < share) request.flagged_cells.push_back(cell);
    }
    const RemeshingReport report = remesh(mesh, lattice, request);
    expect_sound(mesh);
    EXPECT_EQ(report.retries, 0u);
    EXPECT_EQ(test::count_inverted_triangles(mesh.positions(), mesh.triangles()), 0u);
    const MeshMeasures measures = measure_mesh(mesh.positions(), mesh.triangles());
    EXPECT_NEAR(measures.volume, measure_mesh(original.positions(), original.triangles()).volume, 0.04);
    EXPECT_EQ(measures.components, 1u);
    EXPECT_EQ(measures.genus, 0);
  }
}

TEST(Remeshing, MergesTwoSpheres) {
  TriangleMesh mesh = test::joined(
      {test::make_sphere({0.03, -0.02, 0.01}, 1.0, 5), test::make_sphere({1.13, 0.22, 0.31}, 0.9, 5)});
  const RemeshingReport report = remesh_at(mesh, 0.1);
  expect_sound(mesh);
  EXPECT_GT(report.tangled_cells, 0u);
  EXPECT_EQ(report.retries, 0u);
  EXPECT_EQ(measure_mesh(mesh.positions(), mesh.triangles()).components, 1u);
  EXPECT_EQ(test::count_self_intersecting_triangles(mesh.positions(), mesh.triangles()), 0u);
}

}  // namespace
}  // namespace particle_surface_tracker
