#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/lattice_index.h"
#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// Particles sorted into the cells of a sparse, world-anchored lattice, for neighbour searches.
///
/// Cell c is the cube of side cell_size centred at the lattice node c · cell_size. Cells are kept in tiles of 8 × 8 ×
/// 8; only tiles that hold a particle take memory, so an empty kilometre between two drops costs nothing. Inside a tile
/// the cells run with z fastest; inside a cell the particles keep the order of the input. Tiles are in the order of
/// their coordinates, so the sorted order depends on nothing but the input.
class ParticleGrid {
 public:
  static constexpr int tile_width = 8;  ///< Cells along an edge of a tile.

  ParticleGrid() = default;

  /// \param positions finite positions [m], in the order that decides ties (that of the ids).
  /// \param cell_size side of a cell [m], > 0.
  /// \throw ParameterError if the cell size is not a positive number; ParticleError if a position is farther than 2^30
  /// cells from the origin or not finite.
  ParticleGrid(const std::vector<Vec3f>& positions, double cell_size);

  double cell_size() const { return cell_size_; }
  std::size_t size() const { return index_.size(); }

  /// Coordinates in sorted order [m], one array each, for loops that vectorise.
  const std::vector<float>& x() const { return x_; }
  const std::vector<float>& y() const { return y_; }
  const std::vector<float>& z() const { return z_; }

  /// Index into the input for each sorted particle.
  const std::vector<std::uint32_t>& index() const { return index_; }

  /// The cell that a position lies in.
  LatticeCoord cell_of(const Vec3d& position) const;

  /// Calls visit(begin, end) for every non-empty contiguous range of sorted particles in the cells lower..upper
  /// (inclusive). A range never leaves its row of cells (same x and y) or its tile. The order is fixed.
  template <typename Visit>
  void for_each_range(const LatticeCoord& lower, const LatticeCoord& upper, Visit&& visit) const {
    for_each_tile(lower, upper, [&](const Tile& tile) {
      const LocalCells cells(tile.coord, lower, upper);
      for (int i = cells.from[0]; i <= cells.to[0]; ++i) {
        for (int j = cells.from[1]; j <= cells.to[1]; ++j) {
          const std::uint32_t begin = tile.begin[place_of(i, j, cells.from[2])];
          const std::uint32_t end = tile.begin[place_of(i, j, cells.to[2]) + 1];
          if (begin != end) visit(begin, end);
        }
      }
    });
  }

  /// Calls visit(begin, end) for contiguous ranges of sorted particles that together hold those in the cells
  /// lower..upper (inclusive), and others near them: few long ranges instead of many short ones. The order is fixed.
  template <typename Visit>
  void for_each_long_range(const LatticeCoord& lower, const LatticeCoord& upper, Visit&& visit) const {
    for_each_tile(lower, upper, [&](const Tile& tile) {
      const LocalCells cells(tile.coord, lower, upper);
      for (int i = cells.from[0]; i <= cells.to[0]; ++i) {
        const std::uint32_t begin = tile.begin[place_of(i, cells.from[1], cells.from[2])];
        const std::uint32_t end = tile.begin[place_of(i, cells.to[1], cells.to[2]) + 1];
        if (begin != end) visit(begin, end);
      }
    });
  }

  /// One tile: its coordinates (cells / 8, rounded down) and where its cells begin in the sorted arrays.
  struct Tile {
    LatticeCoord coord;
    std::array<std::uint32_t, tile_width * tile_width * tile_width + 1> begin;
  };

  /// Calls visit(cell, begin, end) for every cell of a tile that holds particles, in the order of the sorted arrays.
  template <typename Visit>
  static void for_each_cell(const Tile& tile, Visit&& visit) {
    for (int c = 0; c + 1 < static_cast<int>(tile.begin.size()); ++c) {
      if (tile.begin[c] == tile.begin[c + 1]) continue;
      const LatticeCoord cell = {tile_width * tile.coord[0] + (c >> 6), tile_width * tile.coord[1] + ((c >> 3) & 7),
                                 tile_width * tile.coord[2] + (c & 7)};
      visit(cell, tile.begin[c], tile.begin[c + 1]);
    }
  }

  /// Number of particles in one cell.
  std::uint32_t count(const LatticeCoord& cell) const;

  /// The tiles that hold particles, in the order of their coordinates (x, then y, then z).
  const std::vector<Tile>& tiles() const { return tiles_; }

  /// The tile with these coordinates, or null.
  const Tile* find_tile(const LatticeCoord& tile) const {
    const std::uint32_t number = tile_index_.find(tile);
    return number == LatticeIndex::none ? nullptr : &tiles_[number];
  }

  /// Index (into the input) of the particle nearest to a position; of several, the one with the lowest index. Looks at
  /// the list of tiles and then only into those that can hold it, however far away the particles are.
  /// \return the index, or size() when there are no particles.
  std::size_t nearest(const Vec3d& position) const;

 private:
  static LatticeCoord tile_of(const LatticeCoord& cell) { return {cell[0] >> 3, cell[1] >> 3, cell[2] >> 3}; }

  /// Place of a cell, given relative to its tile, in Tile::begin.
  static int place_of(int i, int j, int k) { return (i * tile_width + j) * tile_width + k; }

  /// The cells of one tile that lie between two cells, relative to the tile.
  struct LocalCells {
    LocalCells(const LatticeCoord& tile, const LatticeCoord& lower, const LatticeCoord& upper) {
      for (int axis = 0; axis < 3; ++axis) {
        const int origin = tile[axis] * tile_width;
        from[axis] = lower[axis] > origin ? lower[axis] - origin : 0;
        to[axis] = upper[axis] < origin + tile_width - 1 ? upper[axis] - origin : tile_width - 1;
      }
    }

    int from[3];
    int to[3];
  };

  template <typename Visit>
  void for_each_tile(const LatticeCoord& lower, const LatticeCoord& upper, Visit&& visit) const {
    const LatticeCoord first = tile_of(lower);
    const LatticeCoord last = tile_of(upper);
    LatticeCoord t;
    for (t[0] = first[0]; t[0] <= last[0]; ++t[0]) {
      for (t[1] = first[1]; t[1] <= last[1]; ++t[1]) {
        for (t[2] = first[2]; t[2] <= last[2]; ++t[2]) {
          const Tile* tile = find_tile(t);
          if (tile != nullptr) visit(*tile);
        }
      }
    }
  }

  double cell_size_ = 1.0;
  double cells_per_meter_ = 1.0;
  std::vector<float> x_, y_, z_;
  std::vector<std::uint32_t> index_;
  std::vector<Tile> tiles_;
  LatticeIndex tile_index_;
};

}  // namespace particle_surface_tracker
