#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <openvdb/Types.h>

#include "stages/nodes/leaf_index.h"
#include "stages/nodes/node_masks.h"

namespace particle_surface_tracker {

/// Numbers the nodes of a sparse set from 0 in the order of their coordinates (x, then y, then z).
class NodeNumbers {
 public:
  static constexpr std::uint32_t none = 0xffffffff;

  explicit NodeNumbers(const NodeMasks& set);

  const std::vector<openvdb::Coord>& nodes() const { return nodes_; }

  /// The number of a node, or none.
  std::uint32_t find(const openvdb::Coord& node) const {
    const std::uint32_t leaf = index_.find(node & ~7);
    if (leaf == LeafIndex::none) return none;
    return numbers_[leaf][static_cast<std::size_t>(64 * (node.x() & 7) + 8 * (node.y() & 7) + (node.z() & 7))];
  }

 private:
  LeafIndex index_;
  std::vector<std::array<std::uint32_t, 512>> numbers_;
  std::vector<openvdb::Coord> nodes_;
};

}  // namespace particle_surface_tracker
