#pragma once

#include <cstdint>
#include <vector>

#include "node_lattice.h"

namespace particle_surface_tracker::implicit {

/// Coordinates of the block that a node is in.
inline LatticeCoord block_of(const LatticeCoord& node) {
  return {node[0] >> 3, node[1] >> 3, node[2] >> 3};
}

/// Requests nodes of the fine lattice, remembering the blocks around one place.
class NodeRequester {
 public:
  NodeRequester(NodeLattice& lattice, int width) : lattice_(lattice), width_(width) {}

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

}  // namespace particle_surface_tracker::implicit
