#include "particle_surface_tracker/core/mesh_measures.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

const Vec3d kOrigin = Vec3d::Zero();
const double kPi = std::acos(-1.0);

MeshMeasures measure(const TriangleMesh& mesh) {
  return measure_mesh(mesh.positions(), mesh.triangles());
}

TEST(MeasureMesh, BoxIsExact) {
  const MeshMeasures box = measure(test::make_box({1, 2, 3}, {3, 5, 7}));
  EXPECT_DOUBLE_EQ(box.volume, 24.0);
  EXPECT_DOUBLE_EQ(box.area, 52.0);
  EXPECT_EQ(box.components, 1U);
  EXPECT_EQ(box.genus, 0);
}

TEST(MeasureMesh, SmallBoxFarFromTheOriginIsExact) {
  const MeshMeasures box = measure(test::make_box({4096, -8192, 1024}, {4096.5, -8191.5, 1024.5}));
  EXPECT_DOUBLE_EQ(box.volume, 0.125);
  EXPECT_DOUBLE_EQ(box.area, 1.5);
}

TEST(MeasureMesh, SphereComesCloseToItsFormulas) {
  const MeshMeasures sphere = measure(test::make_sphere({3, -2, 1}, 2.0, 6));
  EXPECT_NEAR(sphere.volume / (4.0 / 3.0 * kPi * 8.0), 1.0, 1e-3);
  EXPECT_NEAR(sphere.area / (4.0 * kPi * 4.0), 1.0, 1e-3);
}

double smallest_angle(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  return measure_mesh({a, b, c}, {{0, 1, 2}}).smallest_angle;
}

TEST(MeasureMesh, SmallestAngleIsThatOfTheWorstTriangle) {
  EXPECT_NEAR(measure(test::make_box({0, 0, 0}, {1, 1, 1})).smallest_angle, 45.0, 1e-9);
  // Whichever corner it lies at.
  const Vec3f far(1, 0, 0), near(0, 0, 0), up(0, std::tan(3.0F * static_cast<float>(kPi) / 180.0F), 0);
  for (const double angle : {smallest_angle(far, near, up), smallest_angle(near, up, far),
                             smallest_angle(up, far, near), smallest_angle(far, up, near)}) {
    EXPECT_NEAR(angle, 3.0, 1e-5);
  }
  // A needle whose cosine is 1 in doubles.
  EXPECT_NEAR(smallest_angle(near, far, {1, 1e-9F, 0}) / (1e-9 * 180.0 / kPi), 1.0, 1e-6);
  EXPECT_EQ(smallest_angle(near, far, {2, 0, 0}), 0.0);
  EXPECT_EQ(smallest_angle(far, far, far), 0.0);
  EXPECT_NEAR(smallest_angle(near, {1, 0, 0}, {0.5F, std::sqrt(0.75F), 0}), 60.0, 1e-5);
}

TEST(MeasureMesh, TurnedMeshHasNegativeVolume) {
  EXPECT_DOUBLE_EQ(measure(test::turned(test::make_box({0, 0, 0}, {1, 1, 1}))).volume, -1.0);
}

TEST(MeasureMesh, AddsGeneraOfAllComponents) {
  const TriangleMesh torus = test::make_torus(kOrigin, 1.0, 0.3, 12, 8);
  EXPECT_EQ(measure(torus).genus, 1);
  const MeshMeasures all = measure(test::joined({torus, test::make_box({5, 5, 5}, {6, 6, 6}), torus}));
  EXPECT_EQ(all.components, 3U);
  EXPECT_EQ(all.genus, 2);
}

TEST(MeasureMesh, NothingIsZero) {
  const MeshMeasures nothing = measure_mesh({}, {});
  EXPECT_EQ(nothing.components, 0U);
  EXPECT_EQ(nothing.genus, 0);
  EXPECT_EQ(nothing.volume, 0.0);
  EXPECT_EQ(nothing.area, 0.0);
  EXPECT_TRUE(std::isnan(nothing.smallest_angle));
}

TEST(MeasureMesh, SameBitsForAnyNumberOfThreads) {
  const TriangleMesh mesh = test::make_sphere(kOrigin, 1.0, 6);
  const MeshMeasures parallel = measure(mesh);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const MeshMeasures serial = measure(mesh);
  EXPECT_EQ(parallel.volume, serial.volume);
  EXPECT_EQ(parallel.area, serial.area);
  EXPECT_EQ(parallel.smallest_angle, serial.smallest_angle);
}

TEST(MeasureMesh, TheVolumeAloneHasTheSameBits) {
  const TriangleMesh mesh = test::make_sphere(kOrigin, 1.0, 6);
  EXPECT_EQ(signed_volume(mesh.positions(), mesh.triangles()), measure(mesh).volume);
  EXPECT_EQ(signed_volume({}, {}), 0.0);
}

TEST(MeasureMesh, TakesTheComponentsThatTheMeshKeeps) {
  TriangleMesh mesh = test::joined({test::make_box({0, 0, 0}, {1, 1, 1}), test::make_box({2, 0, 0}, {3, 1, 1})});
  EXPECT_EQ(measure_mesh(mesh).components, 2U);
  EXPECT_EQ(measure_mesh(mesh).genus, 0);
  EXPECT_EQ(measure_mesh(mesh).volume, measure(mesh).volume);
  std::vector<Triangle> first(mesh.triangles().begin(), mesh.triangles().begin() + 12);
  mesh.set_triangles(std::move(first));
  mesh.remove_unused_vertices();
  EXPECT_EQ(measure_mesh(mesh).components, 1U);
  EXPECT_EQ(measure_mesh(TriangleMesh()).components, 0U);
}

}  // namespace
}  // namespace particle_surface_tracker
