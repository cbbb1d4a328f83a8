#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh_check_support.h"

namespace particle_surface_tracker {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

TEST(CheckMeshIntersections, CountsSelfIntersectingTriangles) {
  // A thin bar through a cube, off the diagonals of its sides: its eight long triangles cross one triangle below and
  // one above.
  const TriangleMesh bar = test::make_box({0.4, -0.5, -2}, {0.6, -0.3, 2});
  const MeshCheck check = test::check_of(test::joined({test::box(0, 1), bar}));
  EXPECT_THAT(test::counts_of(check), ElementsAre(Pair("self_intersecting_triangles", 10U)));
  EXPECT_DOUBLE_EQ(check.self_intersecting_share(), 10.0 / 24.0);
  EXPECT_FALSE(check.is_sound());
  EXPECT_TRUE(check.is_sound(10.0 / 24.0));
  EXPECT_EQ(check.self_intersecting_triangles.places.size(), MeshDefect::max_places);
  EXPECT_LT(check.self_intersecting_triangles.places[0].index, 12U);
  EXPECT_GE(check.self_intersecting_triangles.places[0].other, 12U);
}

TEST(CheckMeshIntersections, TouchingIsIntersecting) {
  // The tip of a tetrahedron in the middle of a triangle of the cube, off its diagonal.
  const TriangleMesh touching({{0.25F, 0.5F, 1}, {0, 0, 2}, {1, 0, 2}, {0, 1, 2}}, test::kTetrahedron);
  EXPECT_EQ(test::check_of(test::joined({test::unit_box(), touching})).self_intersecting_triangles.count, 1U + 3U);
  TriangleMesh apart = touching;
  apart.positions()[0].z() = std::nextafter(1.0F, 2.0F);
  EXPECT_TRUE(test::check_of(test::joined({test::unit_box(), apart})).is_sound());
}

TEST(CheckMeshIntersections, FoldedTriangle) {
  // Two triangles at an edge, one folded exactly onto the other: a tetrahedron pressed flat.
  const std::vector<Vec3f> positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}};
  const MeshCheck check = check_mesh(positions, test::kTetrahedron);
  EXPECT_THAT(test::counts_of(check),
              UnorderedElementsAre(Pair("self_intersecting_triangles", 4U), Pair("components_without_volume", 1U)));
}

TEST(CheckMeshIntersections, TrianglesThatShareAVertexMayIntersect) {
  // A fan around vertex 0 whose last triangle dips through the first.
  const std::vector<Vec3f> positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 1, 1}, {0.5F, 0.5F, -1}};
  EXPECT_EQ(check_mesh(positions, {{0, 1, 2}, {0, 3, 4}}).self_intersecting_triangles.count, 2U);
  const std::vector<Vec3f> beside = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {-1, -1, 1}, {-0.5F, -0.5F, -1}};
  EXPECT_EQ(check_mesh(beside, {{0, 1, 2}, {0, 3, 4}}).self_intersecting_triangles.count, 0U);
}

}  // namespace
}  // namespace particle_surface_tracker
