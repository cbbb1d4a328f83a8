#include "support/torture_meshes.h"

#include <cmath>

#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/core/mesh_measures.h"
#include "particle_surface_tracker/core/mesh_validation.h"

#include "support/cgal_mesh.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using test::CgalMesh;
using test::to_cgal;
using test::TortureMesh;

/// Volume of the union of two meshes that do not cross themselves, by CGAL.
double union_volume(const TriangleMesh& first, const TriangleMesh& second) {
  CgalMesh left = to_cgal(first);
  CgalMesh right = to_cgal(second);
  CgalMesh both;
  EXPECT_TRUE(CGAL::Polygon_mesh_processing::corefine_and_compute_union(left, right, both));
  return CGAL::to_double(CGAL::Polygon_mesh_processing::volume(both));
}

double covered_volume(const TriangleMesh& mesh) {
  return test::covered_volume(mesh.positions(), mesh.triangles(), 400);
}

TEST(TortureMeshes, AreClosedAndManifold) {
  std::vector<TortureMesh> meshes = test::chosen_torture_meshes();
  for (std::uint32_t seed = 0; seed < 100; ++seed) meshes.push_back(test::make_torture_mesh(seed));
  for (const TortureMesh& torture : meshes) {
    EXPECT_EQ(describe_mesh_defects(torture.mesh.positions(), torture.mesh.triangles()), "") << torture.name;
  }
}

TEST(TortureMeshes, AreTheSameForTheSameSeed) {
  const TortureMesh first = test::make_torture_mesh(7);
  const TortureMesh second = test::make_torture_mesh(7);
  EXPECT_EQ(first.name, second.name);
  EXPECT_EQ(first.mesh.positions(), second.mesh.positions());
  EXPECT_NE(first.name, test::make_torture_mesh(8).name);
}

TEST(TortureMeshes, KnotIsATubeOfGenusOne) {
  const TriangleMesh knot = test::make_knot(Vec3d::Zero(), 0.7, 0.1, 120, 8);
  const MeshMeasures measures = measure_mesh(knot.positions(), knot.triangles());
  EXPECT_EQ(measures.genus, 1);
  EXPECT_GT(measures.volume, 0.0);
  EXPECT_NEAR(covered_volume(knot), measures.volume, 0.01 * measures.volume);
}

TEST(CoveredVolume, OfBoxes) {
  const TriangleMesh box = test::make_box({0, 0, 0}, {1, 1, 1});
  const TriangleMesh other = test::make_box({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5});
  EXPECT_NEAR(covered_volume(box), 1.0, 0.01);
  EXPECT_EQ(covered_volume(test::turned(box)), 0.0);
  EXPECT_NEAR(covered_volume(test::joined({box, box})), 1.0, 0.01);
  EXPECT_NEAR(covered_volume(test::joined({box, other})), 1.875, 0.015);
  EXPECT_NEAR(covered_volume(test::joined({box, test::turned(other)})), 0.875, 0.015);
  EXPECT_EQ(covered_volume(TriangleMesh()), 0.0);
}

TEST(CoveredVolume, OfOverlappingBodiesIsThatOfCgal) {
  const TriangleMesh ball = test::make_sphere({0.1, 0.2, 0.3}, 0.7, 3);
  const TriangleMesh knot = test::make_knot({0, 0.1, 0}, 0.9, 0.15, 96, 8);
  const TriangleMesh torus = test::make_torus({0.3, 0, 0}, 0.6, 0.2, 32, 16);
  const auto expect_same = [](const TriangleMesh& first, const TriangleMesh& second) {
    const double expected = union_volume(first, second);
    EXPECT_NEAR(covered_volume(test::joined({first, second})), expected, 0.003 * expected);
  };
  expect_same(ball, knot);
  expect_same(ball, torus);
  expect_same(knot, torus);
}

}  // namespace
}  // namespace particle_surface_tracker
