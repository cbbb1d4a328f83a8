#include "particle_surface_tracker/core/vertex_normals.h"

#include <cmath>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace particle_surface_tracker::test {
namespace {

TEST(VertexNormals, PointOutwardOnASphere) {
  const TriangleMesh sphere = make_sphere(Vec3d(1, 2, 3), 0.5, 4);
  const std::vector<Vec3f> normals = vertex_normals(sphere.positions(), sphere.triangles());
  ASSERT_EQ(normals.size(), sphere.vertex_count());
  for (std::size_t v = 0; v < normals.size(); ++v) {
    EXPECT_NEAR(normals[v].norm(), 1.0f, 1e-6f);
    EXPECT_GT(normals[v].dot((sphere.positions()[v] - Vec3f(1, 2, 3)).normalized()), 0.999f) << v;
  }
}

TEST(VertexNormals, CornersOfABoxDoNotDependOnItsDiagonals) {
  // Each corner has one or two triangles of each side; the angles make up for that.
  const TriangleMesh box = make_box(Vec3d::Zero(), Vec3d(1, 2, 4));
  const std::vector<Vec3f> normals = vertex_normals(box.positions(), box.triangles());
  for (std::size_t v = 0; v < normals.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      const float outward = box.positions()[v][axis] > 0.0f ? 1.0f : -1.0f;
      EXPECT_NEAR(normals[v][axis], outward / std::sqrt(3.0f), 1e-6f) << v;
    }
  }
}

TEST(VertexNormals, DegenerateTrianglesCountNothing) {
  const std::vector<Vec3f> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
  const std::vector<Vec3f> normals = vertex_normals(positions, {{0, 1, 2}, {0, 1, 3}});
  EXPECT_EQ(normals[0], Vec3f(0, 0, 1));
  EXPECT_EQ(normals[3], Vec3f(0, 0, 0));
}

}  // namespace
}  // namespace particle_surface_tracker::test
