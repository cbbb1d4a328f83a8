#include "ros/vertex_velocities.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace particle_surface_tracker::test {
namespace {

VertexPlaces places_of(const TriangleMesh& mesh) {
  return {mesh.ids(), mesh.positions()};
}

TEST(VertexVelocities, AreDisplacementOverTime) {
  TriangleMesh mesh = make_sphere(Vec3d::Zero(), 1.0, 2);
  const VertexPlaces before = places_of(mesh);
  for (Vec3f& position : mesh.positions()) position += Vec3f(0.5f, 0.0f, position.x());
  const std::vector<Vec3f> velocities = vertex_velocities(before, mesh, 0.25);
  ASSERT_EQ(velocities.size(), mesh.vertex_count());
  for (std::size_t v = 0; v < velocities.size(); ++v) {
    EXPECT_LT((velocities[v] - Vec3f(2.0f, 0.0f, 4.0f * before.positions[v].x())).norm(), 1e-5f) << v;
  }
}

TEST(VertexVelocities, VerticesAreFoundByIdInAnyOrder) {
  const TriangleMesh mesh = make_box(Vec3d::Zero(), Vec3d::Ones());
  VertexPlaces before = places_of(mesh);
  for (std::size_t v = 0; v < before.ids.size(); ++v) {
    before.positions[v].x() -= static_cast<float>(before.ids[v]);
  }
  std::reverse(before.ids.begin(), before.ids.end());
  std::reverse(before.positions.begin(), before.positions.end());
  const std::vector<Vec3f> velocities = vertex_velocities(before, mesh, 1.0);
  for (std::size_t v = 0; v < velocities.size(); ++v) {
    EXPECT_EQ(velocities[v], Vec3f(static_cast<float>(mesh.ids()[v]), 0, 0));
  }
}

TEST(VertexVelocities, NewVerticesTakeTheMeanOfTheirNeighbours) {
  const TriangleMesh mesh = make_sphere(Vec3d::Zero(), 1.0, 3);
  VertexPlaces before;
  // Only the lower half was there, and moved by (1, 2, 3).
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.positions()[v].z() > 0.0f) continue;
    before.ids.push_back(mesh.ids()[v]);
    before.positions.emplace_back(mesh.positions()[v] - Vec3f(1, 2, 3));
  }
  ASSERT_LT(before.ids.size(), mesh.vertex_count());
  for (const Vec3f& velocity : vertex_velocities(before, mesh, 1.0)) {
    EXPECT_LT((velocity - Vec3f(1, 2, 3)).norm(), 1e-5f);
  }
}

TEST(VertexVelocities, NewComponentsRest) {
  const TriangleMesh ball = make_sphere(Vec3d::Zero(), 1.0, 1);
  const TriangleMesh two = joined({ball, make_sphere(Vec3d(5, 0, 0), 1.0, 1)});
  VertexPlaces before = places_of(ball);
  for (Vec3f& position : before.positions) position.y() -= 1.0f;
  const std::vector<Vec3f> velocities = vertex_velocities(before, two, 1.0);
  for (std::size_t v = 0; v < velocities.size(); ++v) {
    EXPECT_NEAR(velocities[v].y(), v < ball.vertex_count() ? 1.0f : 0.0f, 1e-6f) << v;
  }
}

}  // namespace
}  // namespace particle_surface_tracker::test
