#include "cell_prediction.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace particle_surface_tracker::implicit {

namespace {

/// Corner n of a cell is one up in x, y, z where bit 2, 1, 0 of n is set.
LatticeCoord corner(const LatticeCoord& cell, int n) {
  return {cell[0] + ((n >> 2) & 1), cell[1] + ((n >> 1) & 1), cell[2] + (n & 1)};
}

LatticeCoord block_of(const LatticeCoord& node) {
  return {node[0] >> 3, node[1] >> 3, node[2] >> 3};
}

int place_in_block(const LatticeCoord& node) {
  return 64 * (node[0] & 7) + 8 * (node[1] & 7) + (node[2] & 7);
}

/// The first node of a block whose coordinates are multiples of `ratio`.
LatticeCoord first_multiples(const LatticeCoord& block, int ratio) {
  LatticeCoord first;
  for (int axis = 0; axis < 3; ++axis) {
    const int begin = 8 * block[axis];
    first[axis] = begin + ((-begin) % ratio + ratio) % ratio;
  }
  return first;
}

/// Requests nodes of the fine lattice, remembering the blocks around one place.
class Requester {
 public:
  Requester(NodeLattice& lattice, int width) : lattice_(lattice), width_(width) {}

  /// Nodes requested next lie in the blocks origin .. origin + width - 1.
  void move_to(const LatticeCoord& origin) {
    origin_ = origin;
    blocks_.assign(static_cast<std::size_t>(width_) * width_ * width_, kUnknown);
  }

  /// Requests the nodes node + (0, 0, k) for the bits k of a row.
  void request_row(LatticeCoord node, std::uint32_t row) {
    while (row != 0) {
      const int first = node[2] & 7;
      NodeBlock& block = lattice_.blocks()[block_at(node)];
      const std::uint64_t here = (std::uint64_t{row} << first) & 0xFF;
      block.requested[node[0] & 7] |= here << (8 * (node[1] & 7));
      row >>= 8 - first;
      node[2] += 8 - first;
    }
  }

  /// Requests all nodes within `reach` along every axis, at most 4 · (width - 2).
  void request_cube(const LatticeCoord& middle, int reach) {
    move_to(block_of({middle[0] - reach, middle[1] - reach, middle[2] - reach}));
    for (int i = -reach; i <= reach; ++i) {
      for (int j = -reach; j <= reach; ++j) {
        const LatticeCoord first = {middle[0] + i, middle[1] + j, middle[2] - reach};
        for (int k = 0; k <= 2 * reach; ++k) request_row({first[0], first[1], first[2] + k}, 1);
      }
    }
  }

 private:
  static constexpr std::uint32_t kUnknown = ~std::uint32_t{0};

  std::uint32_t block_at(const LatticeCoord& node) {
    const LatticeCoord coord = block_of(node);
    std::uint32_t& block =
        blocks_[((coord[0] - origin_[0]) * width_ + coord[1] - origin_[1]) * width_ + coord[2] - origin_[2]];
    if (block == kUnknown) block = lattice_.touch(coord);
    return block;
  }

  NodeLattice& lattice_;
  int width_;
  LatticeCoord origin_ = {};
  std::vector<std::uint32_t> blocks_;
};

/// The fine nodes of one coarse cell, as rows along z: bit k of row (i, j) stands for node (i, j, k).
/// \tparam Ratio an integer, or the type of a constant one: the loops are then unrolled.
template <typename Ratio>
class FineCells {
 public:
  /// \param ratio at most kLargestRatio.
  /// \param margin how far the interpolation may be off [m].
  FineCells(Ratio ratio, float margin) : ratio_(ratio), margin_(margin) {}

  /// On which sides of the surface the nodes may be, by trilinear interpolation of the values at the corners.
  void interpolate(const std::array<float, 8>& v) {
    const auto mix = [](float a, float b, float t) { return a + (b - a) * t; };
    const float step = 1.0f / static_cast<float>(ratio_);
    int row = 0;
    for (int i = 0; i < width(); ++i) {
      const float t = static_cast<float>(i) * step;
      const float v00 = mix(v[0], v[4], t);
      const float v01 = mix(v[1], v[5], t);
      const float v10 = mix(v[2], v[6], t);
      const float v11 = mix(v[3], v[7], t);
      for (int j = 0; j < width(); ++j, ++row) {
        const float v0 = mix(v00, v10, static_cast<float>(j) * step);
        const float v1 = mix(v01, v11, static_cast<float>(j) * step);
        inside_[row] = 0;
        outside_[row] = 0;
        for (int k = 0; k < width(); ++k) {
          const float value = mix(v0, v1, static_cast<float>(k) * step);
          inside_[row] |= static_cast<std::uint32_t>(value < margin_) << k;
          outside_[row] |= static_cast<std::uint32_t>(value >= -margin_) << k;
        }
      }
    }
  }

  /// Requests the corners of the fine cells that may have corners on both sides.
  void request_mixed(const LatticeCoord& coarse_cell, Requester& requester) {
    const LatticeCoord first = {coarse_cell[0] * ratio_, coarse_cell[1] * ratio_, coarse_cell[2] * ratio_};
    spread_to_cells(inside_);
    spread_to_cells(outside_);
    for (int i = 0; i < width(); ++i) {
      for (int j = 0; j < width(); ++j) {
        std::uint32_t cells = 0;
        for (int x = std::max(i - 1, 0); x <= std::min(i, ratio_ - 1); ++x) {
          for (int y = std::max(j - 1, 0); y <= std::min(j, ratio_ - 1); ++y) {
            cells |= inside_[x * width() + y] & outside_[x * width() + y];
          }
        }
        requester.request_row({first[0] + i, first[1] + j, first[2]}, cells | (cells << 1));
      }
    }
  }

 private:
  using Rows = std::array<std::uint32_t, (kLargestRatio + 1) * (kLargestRatio + 1)>;

  /// From marks of nodes to marks of the cells with any marked corner; the last row of each layer stays unused.
  void spread_to_cells(Rows& rows) const {
    const std::uint32_t all_cells = (std::uint32_t{1} << ratio_) - 1;
    for (int n = 0; n < width() * width(); ++n) rows[n] = (rows[n] | (rows[n] >> 1)) & all_cells;
    for (int n = 0; n + 1 < width() * width(); ++n) rows[n] |= rows[n + 1];
    for (int n = 0; n < ratio_ * width(); ++n) rows[n] |= rows[n + width()];
  }

  int width() const { return ratio_ + 1; }

  Ratio ratio_;
  float margin_;
  Rows inside_;
  Rows outside_;
};

/// Signs of the coarse nodes, remembering the block that was looked at last.
class SignReader {
 public:
  explicit SignReader(const NodeLattice& lattice) : lattice_(lattice) {}

  bool is_inside(const LatticeCoord& node) {
    const LatticeCoord coord = block_of(node);
    if (!is_valid_ || coord != coord_) {
      block_ = lattice_.find(coord);
      coord_ = coord;
      is_valid_ = true;
    }
    const int place = place_in_block(node);
    return block_ != nullptr && ((block_->negative[place >> 6] >> (place & 63)) & 1) != 0;
  }

  /// True where a node is inside or any of the 26 around it.
  bool is_near_inside(const LatticeCoord& node) {
    for (int n = 0; n < 27; ++n) {
      if (is_inside({node[0] + n / 9 - 1, node[1] + n / 3 % 3 - 1, node[2] + n % 3 - 1})) return true;
    }
    return false;
  }

 private:
  const NodeLattice& lattice_;
  const NodeBlock* block_ = nullptr;
  LatticeCoord coord_ = {};
  bool is_valid_ = false;
};

/// request_predicted_cells() for a ratio that may be a constant.
template <typename Ratio>
void request_cells(const NodeLattice& coarse, Ratio ratio, double margin, NodeLattice& fine) {
  Requester requester(fine, ratio + 1);
  FineCells<Ratio> cells(ratio, static_cast<float>(margin));
  for (std::uint32_t index = 0; index < coarse.blocks().size(); ++index) {
    const NodeMask mixed = coarse.mixed_cells(index);
    if (!any(mixed)) continue;
    const LatticeCoord& coord = coarse.blocks()[index].coord;
    requester.move_to({coord[0] * ratio, coord[1] * ratio, coord[2] * ratio});
    std::array<const NodeBlock*, 8> neighbors;
    for (int n = 0; n < 8; ++n) neighbors[n] = coarse.find(corner(coord, n));
    for (int x = 0; x < 8; ++x) {
      for (std::uint64_t rest = mixed[x]; rest != 0; rest &= rest - 1) {
        const int bit = __builtin_ctzll(rest);
        const LatticeCoord cell = {x, bit >> 3, bit & 7};
        std::array<float, 8> values;
        for (int n = 0; n < 8; ++n) {
          const LatticeCoord node = corner(cell, n);
          const NodeBlock* block = neighbors[4 * (node[0] >> 3) + 2 * (node[1] >> 3) + (node[2] >> 3)];
          values[n] = block->values[place_in_block(node)];
        }
        cells.interpolate(values);
        cells.request_mixed({8 * coord[0] + cell[0], 8 * coord[1] + cell[1], 8 * coord[2] + cell[2]}, requester);
      }
    }
  }
}

}  // namespace

void request_predicted_cells(const NodeLattice& coarse, int ratio, double margin, NodeLattice& fine) {
  if (ratio == 2) {
    request_cells(coarse, std::integral_constant<int, 2>{}, margin, fine);
  } else {
    request_cells(coarse, ratio, margin, fine);
  }
}

void request_around_stray_particles(const ParticleGrid& particles, const NodeLattice& coarse, int ratio, int reach,
                                    NodeLattice& fine) {
  SignReader signs(coarse);
  Requester requester(fine, reach / 4 + 2);
  const double fine_cell = particles.cell_size() / ratio;
  for (const ParticleGrid::Tile& tile : particles.tiles()) {
    const NodeBlock* block = coarse.find(tile.coord);
    for (int cell = 0; cell < 512; ++cell) {
      if (tile.begin[cell] == tile.begin[cell + 1]) continue;
      if (block != nullptr && ((block->negative[cell >> 6] >> (cell & 63)) & 1) != 0) continue;
      const LatticeCoord node = {8 * tile.coord[0] + (cell >> 6), 8 * tile.coord[1] + ((cell >> 3) & 7),
                                 8 * tile.coord[2] + (cell & 7)};
      if (signs.is_near_inside(node)) continue;
      for (std::uint32_t n = tile.begin[cell]; n < tile.begin[cell + 1]; ++n) {
        const Vec3d position(particles.x()[n], particles.y()[n], particles.z()[n]);
        const Eigen::Vector3i middle = (position / fine_cell).array().round().cast<int>();
        requester.request_cube({middle.x(), middle.y(), middle.z()}, reach);
      }
    }
  }
}

void request_around_shallow_nodes(const NodeLattice& coarse, int ratio, double depth, NodeLattice& fine) {
  const std::vector<NodeMask> explained = coarse.corners_of_mixed_cells();
  Requester requester(fine, ratio / 4 + 2);
  for (std::uint32_t index = 0; index < explained.size(); ++index) {
    const NodeBlock& block = coarse.blocks()[index];
    for (int x = 0; x < 8; ++x) {
      for (std::uint64_t rest = block.evaluated[x] & block.negative[x] & ~explained[index][x]; rest != 0;
           rest &= rest - 1) {
        const int bit = __builtin_ctzll(rest);
        if (block.values[64 * x + bit] < -depth) continue;
        requester.request_cube({(8 * block.coord[0] + x) * ratio, (8 * block.coord[1] + (bit >> 3)) * ratio,
                                (8 * block.coord[2] + (bit & 7)) * ratio},
                               ratio);
      }
    }
  }
}

void share_values(const NodeLattice& coarse, int ratio, NodeLattice& fine) {
  for (NodeBlock& block : fine.blocks()) {
    const LatticeCoord first = first_multiples(block.coord, ratio);
    const LatticeCoord end = {8 * block.coord[0] + 8, 8 * block.coord[1] + 8, 8 * block.coord[2] + 8};
    const NodeBlock* source = nullptr;
    LatticeCoord node;
    for (node[0] = first[0]; node[0] < end[0]; node[0] += ratio) {
      for (node[1] = first[1]; node[1] < end[1]; node[1] += ratio) {
        for (node[2] = first[2]; node[2] < end[2]; node[2] += ratio) {
          const LatticeCoord coarse_node = {node[0] / ratio, node[1] / ratio, node[2] / ratio};
          const LatticeCoord coord = block_of(coarse_node);
          // Fine blocks have all of their nodes in one coarse block: 8 × 8 × 8 coarse cells are `ratio`³ fine blocks.
          if (source == nullptr) source = coarse.find(coord);
          if (source == nullptr) break;
          const int place = place_in_block(coarse_node);
          const bool is_known = ((source->evaluated[place >> 6] >> (place & 63)) & 1) != 0;
          if (is_known) block.accept_value(place_in_block(node), source->values[place]);
        }
      }
    }
  }
}

}  // namespace particle_surface_tracker::implicit
