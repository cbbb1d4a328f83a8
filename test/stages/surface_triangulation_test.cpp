#include "particle_surface_tracker/stages/surface_triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/mesh_measures.h"
#include "particle_surface_tracker/core/mesh_validation.h"
#include "support/sampled_field.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using openvdb::Coord;

void expect_manifold(const SurfaceTriangulation& surface) {
  EXPECT_NO_THROW(check_closed_manifold(TriangleMesh(surface.vertices, surface.triangles)));
}

/// A field whose signs are random in a cube and positive around it: every pattern and every pair of neighbours occurs.
openvdb::FloatGrid::Ptr random_field(std::uint32_t seed, int width) {
  auto field = openvdb::FloatGrid::create(0.0f);
  auto accessor = field->getAccessor();
  for (int i = -1; i <= width; ++i) {
    for (int j = -1; j <= width; ++j) {
      for (int k = -1; k <= width; ++k) {
        const bool border = i < 0 || j < 0 || k < 0 || i == width || j == width || k == width;
        const double value = test::hash_noise(seed, i, j, k, 0);
        accessor.setValue(Coord(i, j, k), static_cast<float>(border ? std::abs(value) + 0.01 : value));
      }
    }
  }
  return field;
}

TEST(SurfaceTriangulation, IsManifoldForRandomSigns) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const SurfaceTriangulation surface = triangulate_zero_level(*random_field(seed, 13), 0.1);
    EXPECT_GT(surface.triangles.size(), 1000u);
    expect_manifold(surface);
    EXPECT_GT(measure_mesh(surface.vertices, surface.triangles).volume, 0.0);
  }
}

TEST(SurfaceTriangulation, OneInsideNodeGivesAnOctahedron) {
  auto field = openvdb::FloatGrid::create(0.0f);
  const Coord node(-8, 7, 16);  // At the borders of leaves.
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      for (int k = -1; k <= 1; ++k) field->tree().setValue(node.offsetBy(i, j, k), i == 0 && j == 0 && k == 0 ? -1 : 3);
    }
  }
  const SurfaceTriangulation surface = triangulate_zero_level(*field, 0.5);
  EXPECT_EQ(surface.vertices.size(), 6u);
  EXPECT_EQ(surface.triangles.size(), 8u);
  EXPECT_EQ(surface.cells.size(), 9u);
  expect_manifold(surface);
  // Vertices a quarter of a cell away: volume 4/3 a³.
  EXPECT_NEAR(measure_mesh(surface.vertices, surface.triangles).volume, 4.0 / 3.0 * std::pow(0.125, 3), 1e-6);
  for (const Vec3f& v : surface.vertices) EXPECT_NEAR((v - Vec3f(-4, 3.5, 8)).norm(), 0.125f, 1e-6);
}

TEST(SurfaceTriangulation, SphereHasItsVolumeAndTopology) {
  const double dx = 0.1;
  const auto field = test::sample_cut_cells([](const Vec3d& x) { return x.norm() - 1.0; }, dx, 14);
  const SurfaceTriangulation surface = triangulate_zero_level(*field, dx);
  expect_manifold(surface);
  const MeshMeasures measures = measure_mesh(surface.vertices, surface.triangles);
  EXPECT_EQ(measures.components, 1u);
  EXPECT_EQ(measures.genus, 0);
  // All vertices are on the sphere up to the curvature of the field along an edge; no side is longer than √3 dx, so the
  // mesh is at most 3/8 dx² inside.
  const double volume = 4.0 / 3.0 * std::acos(-1.0);
  EXPECT_LT(measures.volume, volume);
  EXPECT_GT(measures.volume, volume - 3 * volume * 3.0 / 8.0 * dx * dx);
}

TEST(SurfaceTriangulation, SurfaceThroughNodesStaysManifoldAndNodesThereAreOutside) {
  for (const float zero : {0.0f, -0.0f}) {
    auto field = openvdb::FloatGrid::create(0.0f);
    for (int i = -3; i <= 3; ++i) {
      for (int j = -3; j <= 3; ++j) {
        for (int k = -3; k <= 3; ++k) {
          const int distance = std::max({std::abs(i), std::abs(j), std::abs(k)}) - 2;
          field->tree().setValue(Coord(i, j, k), distance == 0 ? zero : static_cast<float>(distance));
        }
      }
    }
    const SurfaceTriangulation surface = triangulate_zero_level(*field, 1.0);
    expect_manifold(surface);
    std::set<std::array<float, 3>> positions;
    for (const Vec3f& v : surface.vertices) {
      positions.insert({v.x(), v.y(), v.z()});
      EXPECT_NEAR(v.cwiseAbs().maxCoeff(), 1.999f, 1e-5f);
    }
    EXPECT_EQ(positions.size(), surface.vertices.size());
  }
}

TEST(SurfaceTriangulation, VerticesAreLinearZerosFarFromTheOrigin) {
  const double dx = 0.25;
  const Coord center(40000, -40000, 123456);
  const Vec3d middle = Vec3d(center.x(), center.y(), center.z()) * dx;
  const auto field = test::sample_cut_cells([&](const Vec3d& x) { return (x - middle).norm() - 1.0; }, dx, 6, center);
  const SurfaceTriangulation surface = triangulate_zero_level(*field, dx);
  expect_manifold(surface);
  for (const Vec3f& v : surface.vertices) EXPECT_NEAR((v.cast<double>() - middle).norm(), 1.0, 0.04);
}

TEST(SurfaceTriangulation, CellsHoldTheirTriangles) {
  const SurfaceTriangulation surface = triangulate_zero_level(*random_field(7, 13), 1.0);
  ASSERT_FALSE(surface.cells.empty());
  EXPECT_EQ(surface.cells.front().first_triangle, 0u);
  EXPECT_EQ(surface.cells.back().first_triangle, surface.triangles.size());
  std::set<Coord> origins;
  for (std::size_t c = 0; c + 1 < surface.cells.size(); ++c) {
    const Coord& origin = surface.cells[c].origin;
    EXPECT_TRUE(origins.insert(origin).second);
    EXPECT_LT(surface.cells[c].first_triangle, surface.cells[c + 1].first_triangle);
    for (std::uint32_t t = surface.cells[c].first_triangle; t < surface.cells[c + 1].first_triangle; ++t) {
      for (const std::uint32_t v : surface.triangles[t]) {
        const Vec3f local = surface.vertices[v] - Vec3f(origin.x(), origin.y(), origin.z());
        EXPECT_GE(local.minCoeff(), 0.0f);
        EXPECT_LE(local.maxCoeff(), 1.0f);
      }
    }
  }
}

TEST(SurfaceTriangulation, EmptyAndUncutFieldsGiveNothing) {
  auto field = openvdb::FloatGrid::create(0.0f);
  EXPECT_TRUE(triangulate_zero_level(*field, 1.0).triangles.empty());
  field->tree().setValue(Coord(0), 1.0f);
  const SurfaceTriangulation surface = triangulate_zero_level(*field, 1.0);
  EXPECT_TRUE(surface.vertices.empty());
  EXPECT_EQ(surface.cells.size(), 1u);
}

TEST(SurfaceTriangulation, ActiveTilesCountAsNodes) {
  auto field = openvdb::FloatGrid::create(0.0f);
  field->fill(openvdb::CoordBBox(Coord(-16), Coord(31)), 1.0f, true);
  field->fill(openvdb::CoordBBox(Coord(0), Coord(15)), -1.0f, true);
  field->pruneGrid();
  ASSERT_TRUE(field->tree().hasActiveTiles());
  const SurfaceTriangulation surface = triangulate_zero_level(*field, 1.0);
  expect_manifold(surface);
  EXPECT_NEAR(measure_mesh(surface.vertices, surface.triangles).volume, 16.0 * 16.0 * 16.0, 30.0);
}

TEST(SurfaceTriangulation, EveryLackingCornerIsAnError) {
  for (int corner = 0; corner < 8; ++corner) {
    for (int other = 0; other < 8; ++other) {
      if (other == corner) continue;
      for (const Coord& origin : {Coord(2, 3, 4), Coord(7, 7, 7), Coord(-1, 7, 3)}) {
        auto field = openvdb::FloatGrid::create(0.0f);
        for (int c = 0; c < 8; ++c) {
          if (c != corner)
            field->tree().setValue(origin.offsetBy(c & 1, c >> 1 & 1, c >> 2), c == other ? -1.0f : 1.0f);
        }
        EXPECT_THROW(triangulate_zero_level(*field, 1.0), TrackingError) << corner << " " << other;
      }
    }
  }
}

TEST(SurfaceTriangulation, ValuesThatAreNotFiniteAreErrors) {
  for (const float value : {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
    auto field = random_field(3, 5);
    field->tree().setValue(Coord(2), value);
    EXPECT_THROW(triangulate_zero_level(*field, 1.0), TrackingError);
  }
}

TEST(SurfaceTriangulation, ThreadsDoNotChangeIt) {
  const auto field = random_field(11, 40);
  std::vector<SurfaceTriangulation> results;
  for (const int threads : {1, 2, 4}) {
    tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(triangulate_zero_level(*field, 0.1));
  }
  for (const SurfaceTriangulation& result : results) {
    ASSERT_EQ(result.vertices.size(), results[0].vertices.size());
    EXPECT_EQ(std::memcmp(result.vertices.data(), results[0].vertices.data(), 12 * result.vertices.size()), 0);
    EXPECT_EQ(result.triangles, results[0].triangles);
  }
}

// Where floats are coarse, vertices on several edges of a node must not fall on one place.
TEST(SurfaceTriangulation, FarFromTheOriginNoTwoVerticesAreAtOnePlace) {
  auto field = openvdb::FloatGrid::create(0.0f);
  const Coord node(200000, -160000, 200000);
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      for (int k = -1; k <= 1; ++k) {
        field->tree().setValue(node.offsetBy(i, j, k), i == 0 && j == 0 && k == 0 ? -1e-4f : 1);
      }
    }
  }
  const SurfaceTriangulation surface = triangulate_zero_level(*field, 0.01);
  std::set<std::array<float, 3>> places;
  for (const Vec3f& v : surface.vertices) places.insert({v.x(), v.y(), v.z()});
  EXPECT_EQ(places.size(), surface.vertices.size());
}

}  // namespace
}  // namespace particle_surface_tracker
