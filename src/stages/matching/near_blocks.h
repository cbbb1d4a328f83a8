#pragma once

#include <openvdb/Types.h>

#include "particle_surface_tracker/core/types.h"
#include "stages/nodes/lattice_cell.h"
#include "stages/nodes/node_masks.h"

namespace particle_surface_tracker {

/// Where a set has nodes, in blocks of 8³ nodes: most triangles of a mesh are nowhere near.
class NearBlocks {
 public:
  /// Nodes along an edge of a block.
  static constexpr int kWidth = 8;

  explicit NearBlocks(const NodeMasks& set, double h) : blocks_per_meter_(1.0 / (kWidth * h)) {
    for (const NodeMasks::Leaf& leaf : set.leaves()) {
      if (!is_zero(leaf.words)) blocks_.insert(block_of_leaf(leaf.origin));
    }
    blocks_.dilate(1, 1);
  }

  /// False if no node of the set is within the width of a block of a position.
  bool may_be_near(const Vec3f& position) const {
    return blocks_.contains(cell_of(position.cast<double>() * blocks_per_meter_));
  }

 private:
  static openvdb::Coord block_of_leaf(const openvdb::Coord& origin) {
    return {origin.x() >> 3, origin.y() >> 3, origin.z() >> 3};
  }

  double blocks_per_meter_;
  NodeMasks blocks_;
};

}  // namespace particle_surface_tracker
