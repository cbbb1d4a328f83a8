#include "particle_surface_tracker/core/particle_grid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {

namespace {

constexpr double kLargestCell = 1 << 30;
constexpr std::uint32_t kCellsPerTile = ParticleGrid::tile_width * ParticleGrid::tile_width * ParticleGrid::tile_width;

/// std::floor is a library call on plain x86-64; this is not. The value must fit.
std::int32_t floor_to_int(double value) {
  const auto truncated = static_cast<std::int32_t>(value);
  return truncated - static_cast<std::int32_t>(value < truncated);
}

LatticeCoord cell_at(const Vec3d& position, double cell_size) {
  return {floor_to_int(position.x() / cell_size + 0.5), floor_to_int(position.y() / cell_size + 0.5),
          floor_to_int(position.z() / cell_size + 0.5)};
}

std::uint32_t cell_in_tile(const LatticeCoord& cell) {
  return static_cast<std::uint32_t>((cell[0] & 7) * 64 + (cell[1] & 7) * 8 + (cell[2] & 7));
}

bool is_within(const Vec3f& position, double limit) {
  return std::abs(double{position.x()}) <= limit && std::abs(double{position.y()}) <= limit &&
         std::abs(double{position.z()}) <= limit;
}

[[noreturn]] void throw_too_far(const Vec3f& position, std::size_t index, double cell_size) {
  throw ParticleError(
      fmt::format("Particle {} at ({}, {}, {}) m is farther than 2^30 cells of {} m from the origin: "
                  "check the units of the positions and the particle spacing.",
                  index, position.x(), position.y(), position.z(), cell_size));
}

/// Squared distance from a position to the cube that all particles of a tile lie in. The cube is a little too large:
/// rounding can put a particle just outside its cell.
double squared_distance_to_tile(const Vec3d& position, const LatticeCoord& tile, double cell_size) {
  const double half = 0.5 * ParticleGrid::tile_width * (1.0 + 1e-6) * cell_size;
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double center = (ParticleGrid::tile_width * (tile[axis] + 0.5) - 0.5) * cell_size;
    const double distance = std::max(0.0, std::abs(position[axis] - center) - half);
    sum += distance * distance;
  }
  return sum;
}

}  // namespace

ParticleGrid::ParticleGrid(const std::vector<Vec3f>& positions, double cell_size) : cell_size_(cell_size) {
  if (!(cell_size > 0.0 && std::isfinite(cell_size))) {
    throw ParameterError(
        fmt::format("The cell size of a particle grid is {} m; it must be a positive number.", cell_size));
  }
  const std::size_t count = positions.size();
  std::vector<std::uint32_t> tile_of_particle(count);
  std::vector<std::uint16_t> cell_of_particle(count);

  // Counts per cell, in the order in which the tiles appear.
  const double limit = kLargestCell * cell_size;
  for (std::size_t n = 0; n < count; ++n) {
    // Negated, so that a NaN fails it too.
    if (!is_within(positions[n], limit)) throw_too_far(positions[n], n, cell_size);
    const LatticeCoord cell = cell_at(positions[n].cast<double>(), cell_size);
    const std::uint32_t slot = tile_index_.find_or_insert(tile_of(cell));
    if (slot == tiles_.size()) tiles_.push_back({tile_of(cell), {}});
    tile_of_particle[n] = slot;
    cell_of_particle[n] = static_cast<std::uint16_t>(cell_in_tile(cell));
    ++tiles_[slot].begin[cell_of_particle[n]];
  }

  // Counts become the places where the cells begin, tile after tile in the order of the coordinates.
  std::vector<std::uint32_t> order(tiles_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return tiles_[a].coord < tiles_[b].coord; });
  std::uint32_t begin = 0;
  for (const std::uint32_t tile : order) {
    for (std::uint32_t& cell : tiles_[tile].begin) begin += std::exchange(cell, begin);
  }

  x_.resize(count);
  y_.resize(count);
  z_.resize(count);
  index_.resize(count);
  for (std::size_t n = 0; n < count; ++n) {
    const std::uint32_t place = tiles_[tile_of_particle[n]].begin[cell_of_particle[n]]++;
    x_[place] = positions[n].x();
    y_[place] = positions[n].y();
    z_[place] = positions[n].z();
    index_[place] = static_cast<std::uint32_t>(n);
  }

  // The scatter left every cell's begin where the next cell begins; the last entry never moved.
  std::vector<Tile> sorted;
  sorted.reserve(tiles_.size());
  for (const std::uint32_t tile : order) {
    std::array<std::uint32_t, kCellsPerTile + 1>& cells = tiles_[tile].begin;
    std::copy_backward(cells.begin(), cells.end() - 2, cells.end() - 1);
    cells[0] = sorted.empty() ? 0 : sorted.back().begin[kCellsPerTile];
    tile_index_.renumber(tiles_[tile].coord, static_cast<std::uint32_t>(sorted.size()));
    sorted.push_back(tiles_[tile]);
  }
  tiles_ = std::move(sorted);
}

LatticeCoord ParticleGrid::cell_of(const Vec3d& position) const {
  return cell_at(position, cell_size_);
}

std::uint32_t ParticleGrid::count(const LatticeCoord& cell) const {
  const Tile* tile = find_tile(tile_of(cell));
  if (tile == nullptr) return 0;
  const std::uint32_t local = cell_in_tile(cell);
  return tile->begin[local + 1] - tile->begin[local];
}

std::size_t ParticleGrid::nearest(const Vec3d& position) const {
  using Bound = std::pair<double, std::uint32_t>;
  std::vector<Bound> bounds;
  bounds.reserve(tiles_.size());
  for (std::uint32_t n = 0; n < tiles_.size(); ++n) {
    bounds.emplace_back(squared_distance_to_tile(position, tiles_[n].coord, cell_size_), n);
  }
  std::priority_queue<Bound, std::vector<Bound>, std::greater<>> queue(std::greater<>(), std::move(bounds));

  double best = std::numeric_limits<double>::infinity();
  std::size_t best_index = size();
  for (; !queue.empty() && queue.top().first <= best; queue.pop()) {
    const Tile& tile = tiles_[queue.top().second];
    for (std::uint32_t n = tile.begin[0]; n < tile.begin[kCellsPerTile]; ++n) {
      const double distance = (Vec3d(x_[n], y_[n], z_[n]) - position).squaredNorm();
      if (distance < best || (distance == best && index_[n] < best_index)) {
        best = distance;
        best_index = index_[n];
      }
    }
  }
  return best_index;
}

}  // namespace particle_surface_tracker
