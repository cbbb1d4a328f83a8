#include "particle_surface_tracker/io/gamma_sequence.h"

#include <openvdb/io/File.h>
#include <openvdb/tools/LevelSetMeasure.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"

namespace particle_surface_tracker {
namespace {

constexpr double kRadius = 1.0;
constexpr double kCell = 0.1;
// What the flat triangles of the sphere lie below it at most: a sixty-fourth of an octant is 0.06 long.
constexpr double kFlatness = 1e-3;
const Vec3d kCenter(0.31, -0.17, 12.05);

TriangleMesh ball() {
  return test::make_sphere(kCenter, kRadius, 5);
}

openvdb::FloatGrid::Ptr grid_of(const std::string& path) {
  openvdb::initialize();
  openvdb::io::File file(path);
  file.open();
  return openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("gamma"));
}

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Distance of a node to the sphere [m].
double distance_at(const openvdb::Coord& node) {
  return (Vec3d(node.x(), node.y(), node.z()) * kCell - kCenter).norm() - kRadius;
}

TEST(GammaSequence, HoldsTheSignedDistanceToASphere) {
  const test::TemporaryFolder folder;
  GammaSequence(folder / "new/deep", kCell).write(ball(), 42);
  const auto grid = grid_of(folder / "new/deep/gamma_000042.vdb");
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->getGridClass(), openvdb::GRID_LEVEL_SET);
  EXPECT_DOUBLE_EQ(grid->voxelSize().x(), kCell);
  EXPECT_NEAR(grid->background(), 3 * kCell, 1e-6);
  // Every node of a box around it, also those that are in no leaf.
  const auto accessor = grid->getConstAccessor();
  std::size_t in_band = 0;
  for (int i = -15; i <= 21; ++i) {
    for (int j = -20; j <= 16; ++j) {
      for (int k = 102; k <= 139; ++k) {
        const openvdb::Coord node(i, j, k);
        const double wanted = distance_at(node);
        const bool is_in_band = std::abs(wanted) < 3 * kCell - kFlatness;
        const bool may_be_in_band = std::abs(wanted) < 3 * kCell + kFlatness;
        const double value = accessor.getValue(node);
        in_band += accessor.isValueOn(node) ? 1 : 0;
        if (is_in_band) {
          ASSERT_TRUE(accessor.isValueOn(node)) << node;
        }
        if (!may_be_in_band) {
          ASSERT_FALSE(accessor.isValueOn(node)) << node;
        }
        ASSERT_NEAR(value, std::min(std::max(wanted, -3 * kCell), 3 * kCell), kFlatness) << node;
      }
    }
  }
  EXPECT_EQ(grid->activeVoxelCount(), in_band) << "there are more outside the box";
  EXPECT_NEAR(openvdb::tools::levelSetVolume(*grid), 4.0 / 3.0 * M_PI, 0.03);
}

TEST(GammaSequence, LiquidWithinAirWithinLiquidHasItsSigns) {
  const test::TemporaryFolder folder;
  TriangleMesh cavity = test::make_sphere(kCenter, 0.5, 4);
  TriangleMesh outer = ball();
  std::vector<Vec3f> positions = outer.positions();
  std::vector<Triangle> triangles = outer.triangles();
  const auto offset = static_cast<std::uint32_t>(positions.size());
  positions.insert(positions.end(), cavity.positions().begin(), cavity.positions().end());
  for (const auto& [a, b, c] : cavity.triangles()) triangles.push_back({a + offset, c + offset, b + offset});
  write_gamma_vdb(folder / "a.vdb", TriangleMesh(positions, triangles), kCell);
  const auto grid = grid_of(folder / "a.vdb");
  const auto at = [&grid](double x) {
    return grid->tree().getValue(
        openvdb::Coord::round(grid->worldToIndex({kCenter.x() + x, kCenter.y(), kCenter.z()})));
  };
  EXPECT_GT(at(0.0), 0.0F);
  EXPECT_LT(at(0.75), 0.0F);
  EXPECT_GT(at(1.5), 0.0F);
}

TEST(GammaSequence, TheSameMeshGivesTheSameBytes) {
  const test::TemporaryFolder folder;
  write_gamma_vdb(folder / "a.vdb", ball(), kCell);
  write_gamma_vdb(folder / "b.vdb", ball(), kCell);
  EXPECT_EQ(content_of(folder / "a.vdb"), content_of(folder / "b.vdb"));
}

TEST(GammaSequence, ALiquidThatIsGoneHasNoInside) {
  const test::TemporaryFolder folder;
  write_gamma_vdb(folder / "a.vdb", TriangleMesh(), kCell);
  const auto grid = grid_of(folder / "a.vdb");
  EXPECT_TRUE(grid->empty());
  EXPECT_GT(grid->background(), 0.0F);
}

TEST(GammaSequence, WhatHasNoInsideOrNoPlaceIsAnError) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  EXPECT_THROW(GammaSequence(folder / "file", kCell), OutputError);
  EXPECT_THROW(write_gamma_vdb(folder / "none/a.vdb", ball(), kCell), OutputError);
  EXPECT_THROW(write_gamma_vdb(folder / "a.vdb", ball(), 0.0), ParameterError);
  std::vector<Triangle> open = ball().triangles();
  open.pop_back();
  EXPECT_THROW(write_gamma_vdb(folder / "a.vdb", TriangleMesh(ball().positions(), open), kCell), MeshError);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.vdb"));
}

}  // namespace
}  // namespace particle_surface_tracker
