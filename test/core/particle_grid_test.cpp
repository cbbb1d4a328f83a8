#include "particle_surface_tracker/core/particle_grid.h"

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

constexpr std::uint32_t kSeed = 20170607;

std::vector<Vec3f> random_cloud(std::size_t count, const Vec3f& center, float half_width, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> offset(-half_width, half_width);
  std::vector<Vec3f> positions;
  for (std::size_t n = 0; n < count; ++n) {
    positions.push_back(center + Vec3f(offset(random), offset(random), offset(random)));
  }
  return positions;
}

LatticeCoord cell_by_definition(const Vec3f& p, double cell_size) {
  LatticeCoord cell;
  for (int axis = 0; axis < 3; ++axis) cell[axis] = static_cast<int>(std::floor(double{p[axis]} / cell_size + 0.5));
  return cell;
}

std::size_t nearest_by_definition(const std::vector<Vec3f>& positions, const Vec3d& position) {
  std::size_t best = positions.size();
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < positions.size(); ++n) {
    const double distance = (positions[n].cast<double>() - position).squaredNorm();
    if (distance < smallest) {
      smallest = distance;
      best = n;
    }
  }
  return best;
}

/// Every particle is in the range of its cell, once, with its coordinates, in the order of the input.
void expect_sorted(const std::vector<Vec3f>& positions, const ParticleGrid& grid) {
  ASSERT_EQ(grid.size(), positions.size());
  std::set<std::uint32_t> seen;
  std::uint32_t expected_begin = 0;
  const ParticleGrid::Tile* previous = nullptr;
  for (const ParticleGrid::Tile& tile : grid.tiles()) {
    if (previous != nullptr) {
      EXPECT_LT(previous->coord, tile.coord);
    }
    previous = &tile;
    EXPECT_EQ(grid.find_tile(tile.coord), &tile);
    for (int cell = 0; cell < 512; ++cell) {
      ASSERT_EQ(tile.begin[cell], expected_begin);
      const LatticeCoord coord = {tile.coord[0] * 8 + cell / 64, tile.coord[1] * 8 + cell / 8 % 8,
                                  tile.coord[2] * 8 + cell % 8};
      EXPECT_EQ(grid.count(coord), tile.begin[cell + 1] - tile.begin[cell]);
      for (std::uint32_t n = tile.begin[cell]; n < tile.begin[cell + 1]; ++n) {
        const std::uint32_t index = grid.index()[n];
        EXPECT_TRUE(seen.insert(index).second);
        EXPECT_EQ(Vec3f(grid.x()[n], grid.y()[n], grid.z()[n]), positions[index]);
        EXPECT_EQ(cell_by_definition(positions[index], grid.cell_size()), coord);
        if (n > tile.begin[cell]) {
          EXPECT_LT(grid.index()[n - 1], index);
        }
      }
      expected_begin = tile.begin[cell + 1];
    }
  }
  EXPECT_EQ(seen.size(), positions.size());
}

TEST(ParticleGrid, SortsACloudIntoItsCells) {
  SCOPED_TRACE(kSeed);
  const std::vector<Vec3f> positions = random_cloud(5000, {0.1f, -0.2f, 0.3f}, 1.0f, kSeed);
  expect_sorted(positions, ParticleGrid(positions, 0.07));
}

TEST(ParticleGrid, SortsPositionsOnTheFacesOfCells) {
  std::vector<Vec3f> positions;
  for (int i = -9; i < 9; ++i) {
    for (int j = -9; j < 9; ++j) positions.push_back(0.125f * Vec3f(i + 0.5f, j, -0.5f));
  }
  expect_sorted(positions, ParticleGrid(positions, 0.125));
}

TEST(ParticleGrid, KeepsCoincidentParticlesInTheOrderOfTheInput) {
  const std::vector<Vec3f> positions(100, Vec3f(1.0f, 2.0f, 3.0f));
  const ParticleGrid grid(positions, 0.1);
  expect_sorted(positions, grid);
  EXPECT_EQ(grid.nearest({0.0, 0.0, 0.0}), 0u);
}

TEST(ParticleGrid, IsEmptyWithoutParticles) {
  const ParticleGrid grid({}, 0.1);
  EXPECT_EQ(grid.size(), 0u);
  EXPECT_TRUE(grid.tiles().empty());
  EXPECT_EQ(grid.count({0, 0, 0}), 0u);
  EXPECT_EQ(grid.nearest({0.0, 0.0, 0.0}), 0u);
  EXPECT_EQ(ParticleGrid().nearest({0.0, 0.0, 0.0}), 0u);
}

TEST(ParticleGrid, VisitsExactlyTheCellsOfABox) {
  SCOPED_TRACE(kSeed);
  const std::vector<Vec3f> positions = random_cloud(3000, {0.0f, 0.0f, 0.0f}, 1.0f, kSeed + 1);
  const ParticleGrid grid(positions, 0.06);
  const std::vector<std::pair<LatticeCoord, LatticeCoord>> boxes = {
      {{-3, -9, 2}, {12, 4, 5}}, {{0, 0, 0}, {0, 0, 0}}, {{-40, -40, -40}, {40, 40, 40}}, {{7, 7, 7}, {8, 8, 8}}};
  for (const auto& [lower, upper] : boxes) {
    std::set<std::uint32_t> expected;
    for (std::uint32_t n = 0; n < positions.size(); ++n) {
      const LatticeCoord cell = cell_by_definition(positions[n], 0.06);
      bool inside = true;
      for (int axis = 0; axis < 3; ++axis) inside &= lower[axis] <= cell[axis] && cell[axis] <= upper[axis];
      if (inside) expected.insert(n);
    }
    std::set<std::uint32_t> visited;
    grid.for_each_range(lower, upper, [&](std::uint32_t begin, std::uint32_t end) {
      EXPECT_LT(begin, end);
      for (std::uint32_t n = begin; n < end; ++n) EXPECT_TRUE(visited.insert(grid.index()[n]).second);
    });
    EXPECT_EQ(visited, expected);
  }
}

TEST(ParticleGrid, FindsTheNearestParticle) {
  SCOPED_TRACE(kSeed);
  const std::vector<Vec3f> positions = random_cloud(2000, {5.0f, 0.0f, 0.0f}, 1.0f, kSeed + 2);
  const ParticleGrid grid(positions, 0.05);
  for (const Vec3f& p : random_cloud(300, {5.0f, 0.0f, 0.0f}, 3.0f, kSeed + 3)) {
    EXPECT_EQ(grid.nearest(p.cast<double>()), nearest_by_definition(positions, p.cast<double>()));
  }
  EXPECT_EQ(grid.nearest({1e6, -1e6, 1e6}), nearest_by_definition(positions, {1e6, -1e6, 1e6}));
}

TEST(ParticleGrid, OfSeveralNearestParticlesTakesTheLowestIndex) {
  std::vector<Vec3f> positions;
  for (int i = 8; i >= -8; --i) {
    for (int j = -8; j <= 8; ++j) positions.push_back(Vec3f(i, j, 0.0f));
  }
  const ParticleGrid grid(positions, 1.0);
  for (int i = -8; i < 8; ++i) {
    for (int j = -8; j < 8; ++j) {
      const Vec3d middle(i + 0.5, j + 0.5, 0.0);
      EXPECT_EQ(grid.nearest(middle), nearest_by_definition(positions, middle));
    }
  }
}

TEST(ParticleGrid, TakesMemoryForOccupiedTilesOnly) {
  const ParticleGrid grid({{-500.0f, 0.0f, 0.0f}, {500.0f, 0.0f, 0.0f}}, 0.001);
  EXPECT_EQ(grid.tiles().size(), 2u);
  EXPECT_EQ(grid.nearest({-1.0, 0.0, 0.0}), 0u);
  EXPECT_EQ(grid.nearest({1.0, 0.0, 0.0}), 1u);
}

TEST(ParticleGrid, RejectsWhatDoesNotFitTheLattice) {
  EXPECT_THROW(ParticleGrid({{0.0f, 0.0f, 0.0f}, {0.0f, 2e6f, 0.0f}}, 1e-3), ParticleError);
  EXPECT_THROW(ParticleGrid({{0.0f, 0.0f, std::nanf("")}}, 1e-3), ParticleError);
  EXPECT_THROW(ParticleGrid({}, 0.0), ParameterError);
  EXPECT_THROW(ParticleGrid({}, std::nan("")), ParameterError);
}

}  // namespace
}  // namespace particle_surface_tracker
