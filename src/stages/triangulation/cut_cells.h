#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <oneapi/tbb/parallel_for.h>
#include <openvdb/openvdb.h>

#include "stages/nodes/leaf_index.h"
#include "stages/nodes/leaf_masks.h"

namespace particle_surface_tracker {

/// The cells and edges of one leaf of a field that the zero level passes through. A cell or an edge belongs to the leaf
/// of its node with the smallest coordinates.
struct CutLeaf {
  const openvdb::FloatTree::LeafNodeType* leaf = nullptr;
  std::array<std::uint32_t, 8>
      neighbors{};  ///< Number of the leaf ahead along x, y, z (bits 0, 1, 2), or LeafIndex::none.
  LeafWords active{};
  LeafWords inside{};  ///< Active and below zero.
  LeafWords cells{};
  std::array<LeafWords, 3> edges{};  ///< Per axis.
  std::uint32_t cell_count = 0;
  std::uint32_t edge_count = 0;
  std::uint32_t triangle_count = 0;
  /// What is wrong with the field here; the node where, or the origin of the cell.
  enum class Defect { kNone, kNotFinite, kNoCorner } defect = Defect::kNone;
  openvdb::Coord defect_node;
};

/// All of a field's cut cells and edges, leaf by leaf in the order of the tree.
class CutCells {
 public:
  /// \param tree without active tiles; must outlive this object.
  /// \throw TrackingError if an active value is not finite, or a cut cell has a corner that is not active.
  explicit CutCells(const openvdb::FloatTree& tree);

  const std::vector<CutLeaf>& leaves() const { return leaves_; }

  /// The pattern of signs of each cell of a leaf, as cell_loops() counts them; set where the cell is cut.
  const std::uint8_t* patterns(std::size_t leaf) const { return patterns_.data() + 512 * leaf; }

  /// Calls task(number) for every leaf, several at a time.
  template <typename Task>
  void for_each_leaf(Task&& task) const {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, leaves_.size(), 8), [&](const auto& range) {
      for (std::size_t n = range.begin(); n != range.end(); ++n) task(n);
    });
  }

 private:
  using Neighbors = std::array<std::uint32_t, 8>;

  Neighbors neighbors_of(const openvdb::Coord& origin) const;
  ForwardWords gather(const Neighbors& neighbors, LeafWords CutLeaf::*words) const;
  void read_signs(CutLeaf& leaf) const;
  void find_cuts(CutLeaf& leaf, std::uint8_t* patterns) const;
  void check_leaves_behind(CutLeaf& leaf) const;
  void throw_at_defect() const;

  LeafIndex index_;
  std::vector<CutLeaf> leaves_;
  std::vector<std::uint8_t> patterns_;
};

}  // namespace particle_surface_tracker
