#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/lattice_index.h"

namespace particle_surface_tracker::implicit {

/// One bit per node of a block of 8 × 8 × 8: word x, bit 8 y + z, as in a leaf node of OpenVDB.
using NodeMask = std::array<std::uint64_t, 8>;

/// 8 × 8 × 8 nodes of a lattice and what is known about them.
struct NodeBlock {
  LatticeCoord coord = {};  ///< Coordinates of the first node / 8.
  NodeMask known = {};      ///< The sign is known or presumed.
  NodeMask negative = {};   ///< ... and is negative (inside).
  NodeMask evaluated = {};  ///< The value is known.
  NodeMask requested = {};  ///< The value is to be evaluated next.
  std::array<float, 512> values;

  /// Stores the value of a node (64 x + 8 y + z), which is not requested any more.
  void accept_value(int place, float value) {
    const int x = place >> 6;
    const std::uint64_t bit = std::uint64_t{1} << (place & 63);
    values[place] = value;
    negative[x] = value < 0.0f ? negative[x] | bit : negative[x] & ~bit;
    known[x] |= bit;
    evaluated[x] |= bit;
    requested[x] &= ~bit;
  }
};

/// True where any bit is set.
bool any(const NodeMask& mask);

/// A sparse lattice of nodes with signs and values, in blocks. A cell is named after its node with the smallest
/// coordinates; it is mixed when the signs known at its corners differ.
class NodeLattice {
 public:
  /// \param presume_outside true: nodes nobody has said anything about count as known to be outside; false: as unknown.
  explicit NodeLattice(bool presume_outside) : presume_outside_(presume_outside) {}

  std::vector<NodeBlock>& blocks() { return blocks_; }
  const std::vector<NodeBlock>& blocks() const { return blocks_; }

  /// Index of a block, which is made where it is not there yet. Makes references to blocks invalid.
  std::uint32_t touch(const LatticeCoord& coord);

  /// The block with these coordinates, or null.
  const NodeBlock* find(const LatticeCoord& coord) const {
    const std::uint32_t number = index_.find(coord);
    return number == LatticeIndex::none ? nullptr : &blocks_[number];
  }

  /// The mixed cells of the block with this index.
  NodeMask mixed_cells(std::uint32_t index) const;

  /// The corners of all mixed cells, per block; blocks that do not exist have no place in it.
  std::vector<NodeMask> corners_of_mixed_cells() const;

  /// Requests all corners of some cells of the block with this index, except those evaluated already.
  void request_corners(std::uint32_t index, const NodeMask& cells);

  /// The blocks in which something is requested, in the order in which they were made.
  std::vector<std::uint32_t> blocks_with_requests() const;

  /// The blocks whose cells have a corner in one of `blocks`: these and their lower neighbours, made where missing;
  /// sorted.
  std::vector<std::uint32_t> blocks_with_cells_around(const std::vector<std::uint32_t>& blocks);

 private:
  bool presume_outside_;
  std::vector<NodeBlock> blocks_;
  LatticeIndex index_;
};

/// The nodes of a block at the corners of some of the cells of another: offset (0 or 1 along each axis) leads from the
/// cells' block to the nodes' block.
NodeMask corners_in_block(const NodeMask& cells, const LatticeCoord& offset);

}  // namespace particle_surface_tracker::implicit
