#include "coarse_signs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace particle_surface_tracker::implicit {

namespace {

/// Full: that part of the particles that liquid at rest has in 3 × 3 × 3 cells, and in each of the six 3 × 3 layers at
/// their sides, which would show a surface close by.
constexpr double kFullWindow = 0.85;
constexpr double kFullLayer = 0.5;

/// Particles per cell in a block of 8 × 8 × 8 cells and one layer of cells around it.
struct Counts {
  std::array<std::uint32_t, 1000> cells;
  std::uint32_t& at(int x, int y, int z) { return cells[100 * x + 10 * y + z]; }
};

using Sums = std::array<std::uint32_t, 1000>;

/// Tiles of the particle grid and all others with a cell next to one that holds particles, in a fixed order.
std::vector<LatticeCoord> tiles_around_particles(const ParticleGrid& particles) {
  std::vector<LatticeCoord> around;
  for (const ParticleGrid::Tile& tile : particles.tiles()) {
    std::array<std::array<bool, 3>, 3> on_side = {};  // Per axis: lower side, anywhere, upper side.
    for (int cell = 0; cell < 512; ++cell) {
      if (tile.begin[cell] == tile.begin[cell + 1]) continue;
      const int local[3] = {cell >> 6, (cell >> 3) & 7, cell & 7};
      for (int axis = 0; axis < 3; ++axis) {
        on_side[axis][0] |= local[axis] == 0;
        on_side[axis][1] = true;
        on_side[axis][2] |= local[axis] == 7;
      }
    }
    for (int n = 0; n < 27; ++n) {
      const int step[3] = {n / 9, n / 3 % 3, n % 3};
      if (!on_side[0][step[0]] || !on_side[1][step[1]] || !on_side[2][step[2]]) continue;
      around.push_back({tile.coord[0] + step[0] - 1, tile.coord[1] + step[1] - 1, tile.coord[2] + step[2] - 1});
    }
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  return around;
}

Counts count_particles(const ParticleGrid& particles, const LatticeCoord& coord) {
  Counts counts = {};
  for (int n = 0; n < 27; ++n) {
    const LatticeCoord offset = {n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1};
    const ParticleGrid::Tile* tile =
        particles.find_tile({coord[0] + offset[0], coord[1] + offset[1], coord[2] + offset[2]});
    if (tile == nullptr) continue;
    const auto from = [&](int axis) { return offset[axis] < 0 ? 7 : 0; };
    const auto to = [&](int axis) { return offset[axis] > 0 ? 0 : 7; };
    for (int x = from(0); x <= to(0); ++x) {
      for (int y = from(1); y <= to(1); ++y) {
        for (int z = from(2); z <= to(2); ++z) {
          const int cell = 64 * x + 8 * y + z;
          counts.at(8 * offset[0] + x + 1, 8 * offset[1] + y + 1, 8 * offset[2] + z + 1) =
              tile->begin[cell + 1] - tile->begin[cell];
        }
      }
    }
  }
  return counts;
}

/// Sums over three entries in a row, centred; entries at the ends of the array are not used by anybody.
Sums sum_three(const Sums& values, int stride) {
  Sums sums = {};
  for (int n = stride; n < 1000 - stride; ++n) sums[n] = values[n - stride] + values[n] + values[n + stride];
  return sums;
}

void guess_block(const ParticleGrid& particles, double full_cell, NodeBlock& block) {
  const Sums cells = count_particles(particles, block.coord).cells;
  const Sums rows = sum_three(cells, 1);
  const Sums layers_x = sum_three(rows, 10);
  const Sums layers_y = sum_three(rows, 100);
  const Sums layers_z = sum_three(sum_three(cells, 10), 100);
  const Sums windows = sum_three(layers_x, 100);
  const auto full_window = static_cast<std::uint32_t>(std::ceil(27.0 * kFullWindow * full_cell));
  const auto full_layer = static_cast<std::uint32_t>(std::ceil(9.0 * kFullLayer * full_cell));
  for (int bit = 0; bit < 512; ++bit) {
    const int n = 100 * ((bit >> 6) + 1) + 10 * (((bit >> 3) & 7) + 1) + (bit & 7) + 1;
    if (windows[n] == 0) continue;
    const std::uint32_t thinnest = std::min(
        {layers_x[n - 100], layers_x[n + 100], layers_y[n - 10], layers_y[n + 10], layers_z[n - 1], layers_z[n + 1]});
    const bool is_full = windows[n] >= full_window && thinnest >= full_layer;
    (is_full ? block.negative : block.requested)[bit >> 6] |= std::uint64_t{1} << (bit & 63);
  }
}

}  // namespace

NodeLattice guess_coarse_signs(const ParticleGrid& particles, double particle_spacing) {
  const double full_cell = std::pow(particles.cell_size() / particle_spacing, 3);
  NodeLattice lattice(/*presume_outside*/ true);
  for (const LatticeCoord& coord : tiles_around_particles(particles)) {
    const std::uint32_t index = lattice.touch(coord);
    guess_block(particles, full_cell, lattice.blocks()[index]);
  }
  return lattice;
}

}  // namespace particle_surface_tracker::implicit
