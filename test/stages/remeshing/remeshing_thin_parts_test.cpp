#include <cmath>

#include <gtest/gtest.h>

#include "remeshing_support.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using openvdb::Coord;

/// A sphere whose middle is drawn in to a neck around (0, y, z).
TriangleMesh make_dumbbell(double neck_radius, double y, double z) {
  TriangleMesh mesh = test::make_sphere({0.0, 0.0, 0.0}, 1.0, 5);
  for (Vec3f& p : mesh.positions()) {
    p.x() *= 2.0f;
    const double shrink = 1.0 - (1.0 - neck_radius) * std::exp(-p.x() * p.x());
    p.y() = static_cast<float>(y + shrink * p.y());
    p.z() = static_cast<float>(z + shrink * p.z());
  }
  return mesh;
}

TEST(RemeshingThinParts, BreaksAThreadThatNoNodeIsIn) {
  TriangleMesh mesh = make_dumbbell(0.01, 0.05, 0.05);
  const RemeshingReport report = test::remesh_at(mesh, 0.1);
  test::expect_sound(mesh);
  EXPECT_GT(report.deep_cells, 0u);
  EXPECT_EQ(test::measures_of(mesh).components, 2u);
  EXPECT_EQ(test::count_self_intersecting_triangles(mesh.positions(), mesh.triangles()), 0u);
}

TEST(RemeshingThinParts, KeepsAThreadWithNodesInIt) {
  const TriangleMesh before = make_dumbbell(0.01, 0.0, 0.0);
  TriangleMesh mesh = before;
  EXPECT_FALSE(test::remesh_at(mesh, 0.1).changed());
  test::expect_same(mesh, before);
}

TEST(RemeshingThinParts, KeepsDetailBelowACellNextToTheSurface) {
  TriangleMesh before = test::make_sphere({0.0, 0.0, 0.0}, 1.0, 6);
  for (Vec3f& p : before.positions()) {
    if ((p - Vec3f(0.0f, 0.0f, 1.0f)).norm() < 0.03f) p *= 1.1f;
  }
  TriangleMesh mesh = before;
  EXPECT_FALSE(test::remesh_at(mesh, 0.1).changed());
  test::expect_same(mesh, before);
}

TEST(RemeshingThinParts, RemovesASheetThatNoNodeIsIn) {
  const TriangleMesh sphere = test::make_sphere({0.0, 0.0, 0.0}, 1.0, 5);
  TriangleMesh disc = test::make_sphere({0.0, 0.0, 0.0}, 0.7, 5);
  for (Vec3f& p : disc.positions()) p = Vec3f(p.x() + 3.0f, p.y(), 0.01f * p.z() + 0.05f);
  TriangleMesh mesh = test::joined({sphere, disc});
  const RemeshingReport report = test::remesh_at(mesh, 0.1);
  EXPECT_GT(report.deep_cells, 0u);
  test::expect_same(mesh, sphere);
  EXPECT_TRUE(test::remesh_at(disc, 0.1).changed());
  EXPECT_EQ(disc.triangle_count(), 0u);
  EXPECT_EQ(disc.vertex_count(), 0u);
}

TEST(RemeshingThinParts, KeepsSmallComponentsThatTheParticlesConfirm) {
  const TriangleMesh body = test::make_sphere({0.01, 0.02, 0.03}, 1.0, 5);
  const TriangleMesh drop = test::make_sphere({1.55, 0.05, 0.05}, 0.02, 2);
  const TriangleMesh bubble = test::turned(test::make_sphere({0.05, 0.05, 0.05}, 0.02, 2));
  RemeshingRequest outside_is_liquid;
  outside_is_liquid.is_liquid = [](const Coord& node) { return node.x() > 10; };
  RemeshingRequest inside_is_liquid;
  inside_is_liquid.is_liquid = [](const Coord& node) { return node.x() <= 10; };

  const TriangleMesh before = test::joined({body, drop, bubble});
  TriangleMesh mesh = before;
  EXPECT_EQ(test::remesh_at(mesh, 0.1, outside_is_liquid).kept_components, 2u);
  test::expect_same(mesh, before);
  EXPECT_EQ(test::remesh_at(mesh, 0.1, inside_is_liquid).removed_components, 2u);
  test::expect_same(mesh, body);

  // A drop in liquid and a bubble in air are neither.
  TriangleMesh inside_out = test::joined({body, test::turned(drop), test::turned(bubble)});
  EXPECT_EQ(test::remesh_at(inside_out, 0.1, outside_is_liquid).removed_components, 2u);
  test::expect_same(inside_out, body);
}

}  // namespace
}  // namespace particle_surface_tracker
