#include "coarse_signs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include <emmintrin.h>

namespace particle_surface_tracker::implicit {

namespace {

/// Full: that part of the particles that liquid at rest has in 3 × 3 × 3 cells, and in each of the six 3 × 3 layers at
/// their sides, which would show a surface close by.
constexpr double kFullWindow = 0.85;
constexpr double kFullLayer = 0.5;

/// Particles that are counted in a cell: more than ever matter, and sums over 3 × 3 × 3 cells are still small numbers.
constexpr std::uint32_t kMostCounted = 1000;

/// One number for each cell of a block of 8 × 8 × 8 and of one layer of cells around it. Eight fit into a register.
using CellNumbers = std::array<std::int16_t, 1000>;

constexpr int cell_place(int x, int y, int z) {
  return 100 * (x + 1) + 10 * (y + 1) + z + 1;
}

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

CellNumbers count_particles(const ParticleGrid& particles, const LatticeCoord& coord) {
  CellNumbers counts = {};
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
          const std::uint32_t* begin = &tile->begin[64 * x + 8 * y + z];
          counts[cell_place(8 * offset[0] + x, 8 * offset[1] + y, 8 * offset[2] + z)] =
              static_cast<std::int16_t>(std::min(begin[1] - begin[0], kMostCounted));
        }
      }
    }
  }
  return counts;
}

/// Sums over three entries in a row, centred; entries at the ends of the array are not used by anybody.
CellNumbers sum_three(const CellNumbers& values, int stride) {
  CellNumbers sums = {};
  for (int n = stride; n < 1000 - stride; ++n) {
    sums[n] = static_cast<std::int16_t>(values[n - stride] + values[n] + values[n + stride]);
  }
  return sums;
}

/// The least of two entries on either side.
std::int16_t least_beside(const CellNumbers& values, int n, int stride) {
  return std::min(values[n - stride], values[n + stride]);
}

/// How many of so many cells hold what liquid at rest does.
std::int16_t full_count(double cells, double full_cell) {
  return static_cast<std::int16_t>(std::min(std::ceil(cells * full_cell), 27.0 * kMostCounted));
}

/// Bit z is set where entry z of a row of eight is not 0 but −1.
std::uint64_t bits_of_row(const std::int16_t* row) {
  __m128i eight;
  std::memcpy(&eight, row, sizeof(eight));
  return static_cast<std::uint64_t>(_mm_movemask_epi8(_mm_packs_epi16(eight, _mm_setzero_si128())));
}

void guess_block(const ParticleGrid& particles, double full_cell, NodeBlock& block) {
  const CellNumbers cells = count_particles(particles, block.coord);
  const CellNumbers rows = sum_three(cells, 1);
  const CellNumbers layers_x = sum_three(rows, 10);
  const CellNumbers layers_y = sum_three(rows, 100);
  const CellNumbers layers_z = sum_three(sum_three(cells, 10), 100);
  const CellNumbers windows = sum_three(layers_x, 100);
  const std::int16_t full_window = full_count(27.0 * kFullWindow, full_cell);
  const std::int16_t full_layer = full_count(9.0 * kFullLayer, full_cell);
  CellNumbers is_full;
  CellNumbers is_requested;
  for (int n = cell_place(0, 0, 0); n <= cell_place(7, 7, 7); ++n) {
    const std::int16_t thinnest =
        std::min(std::min(least_beside(layers_x, n, 100), least_beside(layers_y, n, 10)), least_beside(layers_z, n, 1));
    const bool full = (windows[n] >= full_window) & (thinnest >= full_layer);
    is_full[n] = static_cast<std::int16_t>(-static_cast<int>(full));
    is_requested[n] = static_cast<std::int16_t>(-static_cast<int>((windows[n] > 0) & !full));
  }
  for (int x = 0; x < 8; ++x) {
    for (int y = 0; y < 8; ++y) {
      block.negative[x] |= bits_of_row(&is_full[cell_place(x, y, 0)]) << (8 * y);
      block.requested[x] |= bits_of_row(&is_requested[cell_place(x, y, 0)]) << (8 * y);
    }
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
