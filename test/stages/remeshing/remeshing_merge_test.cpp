#include <algorithm>

#include <gtest/gtest.h>

#include "remeshing_support.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Components of positive volume; the others are air inside them.
std::size_t count_bodies(const TriangleMesh& mesh) {
  const auto [component, count] = *mesh.components();
  std::vector<std::vector<Triangle>> parts(count);
  for (const Triangle& triangle : mesh.triangles()) parts[component[triangle[0]]].push_back(triangle);
  return static_cast<std::size_t>(std::count_if(parts.begin(), parts.end(), [&](const std::vector<Triangle>& part) {
    return signed_volume(mesh.positions(), part) > 0.0;
  }));
}

TEST(RemeshingMerge, MergesTwoSpheres) {
  const double distance = 1.5;
  TriangleMesh mesh =
      test::joined({test::make_sphere({0.03, -0.02, 0.01}, 1.0, 5),
                    test::make_sphere(Vec3d(0.03, -0.02, 0.01) + distance * Vec3d(2, 1, 2) / 3.0, 1.0, 5)});
  const RemeshingReport report = test::remesh_at(mesh, 0.1);
  test::expect_sound(mesh);
  EXPECT_GT(report.tangled_cells, 0u);
  EXPECT_EQ(report.retries, 0u);
  EXPECT_EQ(test::measures_of(mesh).components, 1u);
  EXPECT_EQ(test::measures_of(mesh).genus, 0);
  EXPECT_EQ(test::count_self_intersecting_triangles(mesh.positions(), mesh.triangles()), 0u);
  const double lens = kPi * (4.0 + distance) * (2.0 - distance) * (2.0 - distance) / 12.0;
  EXPECT_NEAR(test::measures_of(mesh).volume, 8.0 / 3.0 * kPi - lens, 0.01 * 8.0 / 3.0 * kPi);
}

TEST(RemeshingMerge, MergesBoxesThatShareAFaceOnTheLattice) {
  TriangleMesh mesh = test::joined(
      {test::make_box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}), test::make_box({1.0, 0.0, 0.0}, {2.0, 1.0, 1.0})});
  const RemeshingReport report = test::remesh_at(mesh, 0.125);
  test::expect_sound(mesh);
  EXPECT_EQ(report.retries, 0u);
  EXPECT_EQ(test::measures_of(mesh).components, 1u);
  EXPECT_EQ(test::measures_of(mesh).genus, 0);
  EXPECT_NEAR(test::measures_of(mesh).volume, 2.0, 0.02);
}

TEST(RemeshingMerge, MergesCoincidentCopies) {
  const TriangleMesh sphere = test::make_sphere({0.0, 0.0, 0.0}, 1.0, 4);
  TriangleMesh mesh = test::joined({sphere, sphere, sphere});
  test::remesh_at(mesh, 0.125);
  test::expect_sound(mesh);
  EXPECT_EQ(test::measures_of(mesh).components, 1u);
  EXPECT_NEAR(test::measures_of(mesh).volume, test::measures_of(sphere).volume,
              0.01 * test::measures_of(sphere).volume);
}

TEST(RemeshingMerge, RemovesASolidInASolidButKeepsACavity) {
  const TriangleMesh outer = test::make_sphere({0.01, 0.02, 0.03}, 1.0, 5);
  const TriangleMesh inner = test::make_sphere({0.04, 0.02, 0.03}, 0.5, 4);
  TriangleMesh solids = test::joined({outer, inner});
  test::remesh_at(solids, 0.1);
  test::expect_same(solids, outer);
  const TriangleMesh before = test::joined({outer, test::turned(inner)});
  TriangleMesh cavity = before;
  EXPECT_FALSE(test::remesh_at(cavity, 0.1).changed());
  test::expect_same(cavity, before);
}

TEST(RemeshingMerge, BodiesPassThroughEachOther) {
  TriangleMesh mesh = test::joined(
      {test::make_sphere({-0.7, 0.02, 0.01}, 0.6, 4), test::make_torus({0.6, 0.13, -0.05}, 0.5, 0.2, 40, 16)});
  const std::size_t speed = mesh.attributes().add("speed", 1, {0.0f});
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    mesh.attributes()[speed].values[v] = mesh.positions()[v].x() < 0.0f ? 0.02f : -0.02f;
  }
  bool were_one = false;
  for (int step = 0; step < 50; ++step) {
    SCOPED_TRACE(step);
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      mesh.positions()[v].x() += mesh.attributes()[speed].values[v];
    }
    const RemeshingReport report = test::remesh_at(mesh, 0.1);
    test::expect_sound(mesh);
    EXPECT_EQ(report.fallbacks, 0u);
    EXPECT_FALSE(report.gave_up);
    const std::size_t bodies = count_bodies(mesh);
    EXPECT_LE(bodies, were_one ? 1u : 2u);
    were_one = bodies == 1;
  }
  EXPECT_TRUE(were_one);
}

}  // namespace
}  // namespace particle_surface_tracker
