#include "union_reference.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <gtest/gtest.h>

#include "support/cgal_mesh.h"
#include "support/shapes.h"
#include "support/torture_meshes.h"

namespace particle_surface_tracker {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using test::CgalMesh;
using test::to_cgal;

/// Of two bodies that do not cross themselves: the samples lie on CGAL's union, but for the offset and its rounding,
/// and nowhere is one missing.
void expect_union_of_cgal(const TriangleMesh& first, const TriangleMesh& second) {
  constexpr double kSpacing = 0.02;
  CgalMesh left = to_cgal(first);
  CgalMesh right = to_cgal(second);
  CgalMesh both;
  ASSERT_TRUE(PMP::corefine_and_compute_union(left, right, both));
  const test::UnionReference reference(test::joined({first, second}), kSpacing, 1e-4);
  EXPECT_NEAR(reference.area(), PMP::area(both), 0.01 * PMP::area(both));
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<CgalMesh>;
  CGAL::AABB_tree<CGAL::AABB_traits<test::CgalKernel, Primitive>> tree(faces(both).first, faces(both).second, both);
  for (const Vec3d& p : reference.samples()) {
    ASSERT_LT(tree.squared_distance(test::CgalKernel::Point_3(p.x(), p.y(), p.z())), 4e-8);
  }
  for (const auto vertex : vertices(both)) {
    const test::CgalKernel::Point_3& p = both.point(vertex);
    ASSERT_LT(reference.distance(Vec3d(p.x(), p.y(), p.z())), 1.5 * kSpacing);
  }
}

TEST(UnionReference, IsTheUnionOfCgal) {
  const TriangleMesh ball = test::make_sphere({0.1, 0.2, 0.3}, 0.7, 3);
  const TriangleMesh knot = test::make_knot({0, 0.1, 0}, 0.9, 0.15, 96, 8);
  const TriangleMesh torus = test::make_torus({0.3, 0, 0}, 0.6, 0.2, 32, 16);
  const TriangleMesh box = test::make_box({-0.5, -0.4, 0.1}, {0.4, 0.6, 0.9});
  expect_union_of_cgal(ball, knot);
  expect_union_of_cgal(ball, torus);
  expect_union_of_cgal(knot, torus);
  expect_union_of_cgal(box, ball);
}

TEST(UnionReference, LeavesOutWhatIsBuriedAndWhatCancels) {
  const TriangleMesh box = test::make_box({0, 0, 0}, {1, 1, 1});
  const TriangleMesh inner = test::make_box({0.2, 0.2, 0.2}, {0.8, 0.8, 0.8});
  EXPECT_NEAR(test::UnionReference(box, 0.1, 1e-3).area(), 6.0, 1e-6);
  EXPECT_NEAR(test::UnionReference(test::joined({box, box}), 0.1, 1e-3).area(), 12.0, 1e-6);
  EXPECT_NEAR(test::UnionReference(test::joined({box, inner}), 0.1, 1e-3).area(), 6.0, 1e-6);
  EXPECT_NEAR(test::UnionReference(test::joined({box, test::turned(inner)}), 0.1, 1e-3).area(), 6.0 + 6.0 * 0.36, 1e-6);
  const test::UnionReference nothing(test::joined({box, test::turned(box)}), 0.1, 1e-3);
  EXPECT_TRUE(nothing.samples().empty());
  EXPECT_GT(nothing.distance(Vec3d::Zero()), 1e9);
}

}  // namespace
}  // namespace particle_surface_tracker
