#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <openvdb/Types.h>

#include "leaf_index.h"
#include "leaf_masks.h"

namespace particle_surface_tracker {

/// A sparse set of lattice nodes (or cells, by their lowest corner): one mask per leaf of 8³.
class NodeMasks {
 public:
  struct Leaf {
    openvdb::Coord origin;
    LeafWords words{};
  };

  explicit NodeMasks(std::size_t expected_leaves = 64) : index_(expected_leaves) {}

  const std::vector<Leaf>& leaves() const { return leaves_; }

  /// Number of the leaf with that origin, or LeafIndex::none.
  std::uint32_t find(const openvdb::Coord& origin) const { return index_.find(origin); }

  void insert(const openvdb::Coord& node) {
    words_at(node & ~7)[node.x() & 7] |= std::uint64_t{1} << (8 * (node.y() & 7) + (node.z() & 7));
  }

  bool contains(const openvdb::Coord& node) const;

  /// Number of the leaf with that origin, which is made where it is not there yet.
  std::uint32_t number_of(const openvdb::Coord& origin) {
    if (last_ != LeafIndex::none && leaves_[last_].origin == origin) return last_;
    last_ = index_.find(origin);
    if (last_ == LeafIndex::none) {
      last_ = static_cast<std::uint32_t>(leaves_.size());
      leaves_.push_back({origin});
      index_.insert(origin, last_);
    }
    return last_;
  }

  /// The mask of a leaf, which is made where it is not there yet. Valid until another leaf is made.
  LeafWords& words_at(const openvdb::Coord& origin) { return leaves_[number_of(origin)].words; }

  /// Adds to every node those up to `down` below and up to `up` above it along each axis.
  void dilate(int down, int up);

 private:
  void add_moved(int axis, int direction, int distance);

  std::vector<Leaf> leaves_;
  LeafIndex index_;
  std::uint32_t last_ = LeafIndex::none;
};

/// Bits that leave a mask when it moves along an axis come out at the far side of the next leaf's.
struct MovedWords {
  LeafWords inside{};   ///< What stays in the leaf.
  LeafWords outside{};  ///< What belongs to the next leaf in that direction.
};

/// A mask moved along an axis.
/// \param direction +1 or −1.
/// \param distance 1 to 8 nodes.
MovedWords move_words(const LeafWords& words, int axis, int direction, int distance = 1);

/// True if no bit is set.
bool is_zero(const LeafWords& words);

/// The nodes that a lattice edge joins to one of a set (the cells that share a face with one): some of the set too.
NodeMasks nodes_beside(const NodeMasks& set);

}  // namespace particle_surface_tracker
