#include "particle_surface_tracker/core/particle_grid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

#include <emmintrin.h>
#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {

namespace {

constexpr double kFarthestCell = 1 << 30;
constexpr std::uint32_t kCellsPerTile = ParticleGrid::tile_width * ParticleGrid::tile_width * ParticleGrid::tile_width;

/// Coordinates of a cell in one register; the fourth means nothing.
using CellLanes = std::int32_t __attribute__((vector_size(16)));

/// Finds the cells that positions lie in, all coordinates at once.
class CellFinder {
 public:
  explicit CellFinder(double cells_per_meter) : cells_per_meter_(_mm_set1_pd(cells_per_meter)) {}

  CellLanes cell_of(const Vec3d& position) const {
    return nearest_nodes(_mm_loadu_pd(position.data()) * cells_per_meter_,
                         _mm_load_sd(position.data() + 2) * cells_per_meter_);
  }

  /// \return false if the position is too far from the origin, or not a number.
  bool find(const Vec3f& position, CellLanes& cell) const {
    const __m128d xy = _mm_cvtps_pd(_mm_setr_ps(position.x(), position.y(), 0.0f, 0.0f)) * cells_per_meter_;
    const __m128d z = _mm_cvtps_pd(_mm_set_ss(position.z())) * cells_per_meter_;
    const __m128d sign = _mm_set1_pd(-0.0);
    const __m128d farthest = _mm_max_pd(_mm_andnot_pd(sign, z), _mm_andnot_pd(sign, xy));
    cell = nearest_nodes(xy, z);
    return _mm_movemask_pd(_mm_cmple_pd(farthest, _mm_set1_pd(kFarthestCell))) == 3 && z[0] == z[0];
  }

 private:
  /// Rounds down after adding a half: std::floor is a library call on plain x86-64.
  static CellLanes nearest_nodes(const __m128d& xy, const __m128d& z) {
    const __m128d half = _mm_set1_pd(0.5);
    const __m128d up_xy = xy + half;
    const __m128d up_z = z + half;
    const __m128i cut_xy = _mm_cvttpd_epi32(up_xy);
    const __m128i cut_z = _mm_cvttpd_epi32(up_z);
    const __m128 too_high_xy = _mm_castpd_ps(_mm_cmplt_pd(up_xy, _mm_cvtepi32_pd(cut_xy)));
    const __m128 too_high_z = _mm_castpd_ps(_mm_cmplt_pd(up_z, _mm_cvtepi32_pd(cut_z)));
    const __m128i too_high = _mm_castps_si128(_mm_shuffle_ps(too_high_xy, too_high_z, _MM_SHUFFLE(2, 0, 2, 0)));
    return CellLanes(_mm_add_epi32(_mm_unpacklo_epi64(cut_xy, cut_z), too_high));
  }

  __m128d cells_per_meter_;
};

LatticeCoord to_coord(const CellLanes& cell) {
  return {cell[0], cell[1], cell[2]};
}

bool is_same(const CellLanes& a, const CellLanes& b) {
  return (_mm_movemask_ps(_mm_castsi128_ps(__m128i(a == b))) & 7) == 7;
}

/// \tparam Cell LatticeCoord or CellLanes.
template <typename Cell>
std::uint32_t cell_in_tile(const Cell& cell) {
  return static_cast<std::uint32_t>((cell[0] & 7) * 64 + (cell[1] & 7) * 8 + (cell[2] & 7));
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

ParticleGrid::ParticleGrid(const std::vector<Vec3f>& positions, double cell_size)
    : cell_size_(cell_size), cells_per_meter_(1.0 / cell_size) {
  if (!(cell_size > 0.0 && std::isfinite(cell_size))) {
    throw ParameterError(
        fmt::format("The cell size of a particle grid is {} m; it must be a positive number.", cell_size));
  }
  const std::size_t count = positions.size();
  std::vector<std::uint32_t> tile_of_particle(count);
  std::vector<std::uint16_t> cell_of_particle(count);

  // Counts per cell, in the order in which the tiles appear.
  const CellFinder finder(cells_per_meter_);
  CellLanes last_tile{};
  std::uint32_t slot = LatticeIndex::none;
  for (std::size_t n = 0; n < count; ++n) {
    CellLanes cell;
    if (!finder.find(positions[n], cell)) throw_too_far(positions[n], n, cell_size);
    // Neighbours in the input are mostly neighbours in space.
    const CellLanes tile = cell >> 3;
    if (slot == LatticeIndex::none || !is_same(tile, last_tile)) {
      last_tile = tile;
      slot = tile_index_.find_or_insert(to_coord(tile));
      if (slot == tiles_.size()) tiles_.push_back({to_coord(tile), {}});
    }
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
  return to_coord(CellFinder(cells_per_meter_).cell_of(position));
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
