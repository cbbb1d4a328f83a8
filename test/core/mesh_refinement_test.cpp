#include "particle_surface_tracker/core/mesh_refinement.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/mesh_measures.h"
#include "particle_surface_tracker/core/mesh_validation.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

double longest_edge(const TriangleMesh& mesh) {
  double longest = 0.0;
  for (const Triangle& t : mesh.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d edge = mesh.positions()[t[k]].cast<double>() - mesh.positions()[t[(k + 1) % 3]].cast<double>();
      longest = std::max(longest, edge.norm());
    }
  }
  return longest;
}

TEST(SplitLongEdges, LeavesAMeshOfShortEdgesAlone) {
  TriangleMesh mesh = test::make_sphere(Vec3d::Zero(), 1.0, 3);
  const TriangleMesh before = mesh;
  split_long_edges(mesh, longest_edge(mesh));
  EXPECT_EQ(mesh.positions(), before.positions());
  EXPECT_EQ(mesh.triangles(), before.triangles());
}

TEST(SplitLongEdges, SplitsTheDiagonalsOfABoxOnce) {
  TriangleMesh mesh = test::make_box({0, 0, 0}, {1, 1, 1});
  split_long_edges(mesh, 1.0);
  EXPECT_EQ(mesh.vertex_count(), 14U);
  EXPECT_EQ(mesh.triangle_count(), 24U);
  EXPECT_EQ(longest_edge(mesh), 1.0);
  check_closed_manifold(mesh);
}

TEST(SplitLongEdges, KeepsTheShapeExactly) {
  TriangleMesh mesh = test::joined({test::make_box({0, 0, 0}, {1, 2, 4}), test::make_box({8, 8, 8}, {9, 9, 9})});
  const MeshMeasures before = measure_mesh(mesh.positions(), mesh.triangles());
  split_long_edges(mesh, 0.2);
  const MeshMeasures after = measure_mesh(mesh.positions(), mesh.triangles());
  EXPECT_LE(longest_edge(mesh), 0.2);
  EXPECT_DOUBLE_EQ(after.volume, before.volume);
  EXPECT_NEAR(after.area, before.area, 1e-12 * before.area);
  EXPECT_EQ(after.genus, 0);
  EXPECT_EQ(after.components, 2U);
  check_closed_manifold(mesh);
}

TEST(SplitLongEdges, KeepsACurvedMeshClosedAndItsVolume) {
  TriangleMesh mesh = test::make_torus({0.1, 0.2, 0.3}, 1.0, 0.31, 17, 9);
  const std::vector<Vec3f> first = mesh.positions();
  const MeshMeasures before = measure_mesh(mesh.positions(), mesh.triangles());
  split_long_edges(mesh, 0.04);
  const MeshMeasures after = measure_mesh(mesh.positions(), mesh.triangles());
  EXPECT_LE(longest_edge(mesh), 0.04);
  // Midpoints are rounded to floats.
  EXPECT_NEAR(after.volume / before.volume, 1.0, 1e-6);
  EXPECT_EQ(after.genus, 1);
  check_closed_manifold(mesh);
  EXPECT_TRUE(std::equal(first.begin(), first.end(), mesh.positions().begin()));
}

TEST(SplitLongEdges, BlendsAttributesHalfAndHalfAndGivesNewIds) {
  // The x coordinate as an attribute stays the x coordinate when every blend is half and half.
  TriangleMesh mesh = test::make_box({0, 0, 0}, {1, 1, 1});
  const std::size_t index = mesh.attributes().add("x", 1, {0.0F});
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) mesh.attributes()[index].values[v] = mesh.positions()[v].x();
  split_long_edges(mesh, 0.1);
  ASSERT_GT(mesh.vertex_count(), 8U);
  ASSERT_EQ(mesh.attributes()[index].values.size(), mesh.vertex_count());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_EQ(mesh.attributes()[index].values[v], mesh.positions()[v].x());
    EXPECT_EQ(mesh.ids()[v], v);
  }
}

TEST(SplitLongEdges, TakesTheLongestEdgeFirst) {
  TriangleMesh mesh({{0, 0, 0}, {8, 0, 0}, {0, 4, 0}, {0, 0, 2}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
  split_long_edges(mesh, 8.1);
  // Longer than 8.1 are (1, 2) with √80 and (1, 3) with √68; the new edges at their middles are shorter.
  ASSERT_EQ(mesh.vertex_count(), 6U);
  EXPECT_EQ(mesh.positions()[4], Vec3f(4, 2, 0));
  EXPECT_EQ(mesh.positions()[5], Vec3f(4, 0, 1));
  check_closed_manifold(mesh);
}

TEST(SplitLongEdges, StopsWhereNeighbouringFloatsHaveNoMiddle) {
  const float x = 1.0F;
  const float next = std::nextafter(x, 2.0F);
  TriangleMesh mesh = test::make_box(Vec3d(x, x, x), Vec3d(next, next, next));
  split_long_edges(mesh, 1e-12);
  EXPECT_EQ(mesh.vertex_count(), 8U);
  EXPECT_EQ(mesh.triangle_count(), 12U);
}

TEST(SplitLongEdges, RefusesLengthsThatAreNone) {
  TriangleMesh mesh = test::make_box({0, 0, 0}, {1, 1, 1});
  for (const double length : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW(split_long_edges(mesh, length), ParameterError) << length;
  }
  EXPECT_EQ(mesh.vertex_count(), 8U);
}

}  // namespace
}  // namespace particle_surface_tracker
