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

TEST(VertexComponents, NumbersComponentsByTheirLowestVertex) {
  // Components {0, 3, 5}, {1, 2, 7} and {4, 6, 8, 9}, connected in an order that is not theirs.
  const std::vector<Triangle> triangles = {{9, 8, 6}, {5, 3, 0}, {7, 2, 1}, {8, 6, 4}};
  std::size_t count = 0;
  const std::vector<std::uint32_t> expected = {0, 1, 1, 0, 2, 0, 2, 1, 2, 2};
  EXPECT_EQ(vertex_components(10, triangles, count), expected);
  EXPECT_EQ(count, 3U);
}

TEST(VertexComponents, AgreesWithFloodFillOnARandomGraph) {
  constexpr std::uint32_t kSeed = 20170, kVertices = 600;
  SCOPED_TRACE(kSeed);
  const auto pick = [](std::int32_t i, std::int32_t k) {
    return static_cast<std::uint32_t>((test::hash_noise(kSeed, i, k, 0, 0) + 1.0) / 2.0 * kVertices);
  };
  std::vector<Triangle> triangles;
  for (std::int32_t i = 0; i < 150; ++i) triangles.push_back({pick(i, 0), pick(i, 1), pick(i, 2)});

  std::vector<std::uint32_t> expected(kVertices);
  for (std::uint32_t v = 0; v < kVertices; ++v) expected[v] = v;
  for (bool changed = true; changed;) {
    changed = false;
    for (const Triangle& t : triangles) {
      const std::uint32_t lowest = std::min({expected[t[0]], expected[t[1]], expected[t[2]]});
      for (const std::uint32_t v : t) {
        changed |= expected[v] != lowest;
        expected[v] = lowest;
      }
    }
  }
  std::vector<std::uint32_t> lowest = expected;
  std::sort(lowest.begin(), lowest.end());
  lowest.erase(std::unique(lowest.begin(), lowest.end()), lowest.end());
  for (std::uint32_t& label : expected) {
    label = static_cast<std::uint32_t>(std::lower_bound(lowest.begin(), lowest.end(), label) - lowest.begin());
  }

  std::size_t count = 0;
  EXPECT_EQ(vertex_components(kVertices, triangles, count), expected);
  EXPECT_EQ(count, lowest.size());
}

}  // namespace
}  // namespace particle_surface_tracker
