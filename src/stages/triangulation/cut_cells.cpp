#include "cut_cells.h"

#include <cmath>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"

#include "loop_filling.h"

namespace particle_surface_tracker {

namespace {

using openvdb::Coord;

constexpr LeafWords kNoNodes{};

Coord forward(const Coord& origin, int n) {
  return origin.offsetBy(8 * (n & 1), 8 * (n >> 1 & 1), 8 * (n >> 2 & 1));
}

/// The masks of active and inside nodes at the corners of the cells of one slice.
struct SliceSigns {
  SliceCorners active;
  SliceCorners inside;

  SliceSigns(const ForwardWords& active_words, const ForwardWords& inside_words, int x)
      : active(slice_corners(active_words, x)), inside(slice_corners(inside_words, x)) {}
};

/// Cells with a corner inside and a corner outside.
std::uint64_t cut_cells(const SliceSigns& lower, const SliceSigns& upper) {
  std::uint64_t any_inside = 0;
  std::uint64_t any_outside = 0;
  for (int c = 0; c < 4; ++c) {
    any_inside |= lower.inside[c] | upper.inside[c];
    any_outside |= (lower.active[c] & ~lower.inside[c]) | (upper.active[c] & ~upper.inside[c]);
  }
  return any_inside & any_outside;
}

/// Cells whose corners all have a value.
std::uint64_t whole_cells(const SliceSigns& lower, const SliceSigns& upper) {
  std::uint64_t all_active = ~0ull;
  for (int c = 0; c < 4; ++c) all_active &= lower.active[c] & upper.active[c];
  return all_active;
}

std::uint8_t pattern_of(const SliceSigns& lower, const SliceSigns& upper, int bit) {
  unsigned pattern = 0;
  for (int c = 0; c < 4; ++c) {
    pattern |= static_cast<unsigned>(lower.inside[c] >> bit & 1) << 2 * c;
    pattern |= static_cast<unsigned>(upper.inside[c] >> bit & 1) << (2 * c + 1);
  }
  return static_cast<std::uint8_t>(pattern);
}

/// Nodes of a leaf that are corners of cells of the leaf behind it along x, y, z (bits 0, 1, 2 of n).
bool has_nodes_at_border(const LeafWords& words, int n) {
  const std::uint64_t rows = (n & 2 ? 0xffull : ~0ull) & (n & 4 ? kLowestZ : ~0ull);
  std::uint64_t found = 0;
  for (int x = 0; x < (n & 1 ? 1 : 8); ++x) found |= words[x] & rows;
  return found != 0;
}

}  // namespace

CutCells::CutCells(const openvdb::FloatTree& tree)
    : index_(tree.leafCount()), leaves_(tree.leafCount()), patterns_(512 * leaves_.size()) {
  std::uint32_t number = 0;
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
    leaves_[number].leaf = &*leaf;
    index_.insert(leaf->origin(), number++);
  }
  for_each_leaf([&](std::size_t n) { read_signs(leaves_[n]); });
  throw_at_defect();
  for_each_leaf([&](std::size_t n) { find_cuts(leaves_[n], patterns_.data() + 512 * n); });
  throw_at_defect();
}

CutCells::Neighbors CutCells::neighbors_of(const Coord& origin) const {
  Neighbors neighbors;
  for (int n = 0; n < 8; ++n) neighbors[n] = index_.find(forward(origin, n));
  return neighbors;
}

ForwardWords CutCells::gather(const Neighbors& neighbors, LeafWords CutLeaf::*words) const {
  ForwardWords result;
  for (int n = 0; n < 8; ++n) {
    result[n] = neighbors[n] == LeafIndex::none ? &kNoNodes : &(leaves_[neighbors[n]].*words);
  }
  return result;
}

void CutCells::read_signs(CutLeaf& leaf) const {
  const float* values = leaf.leaf->buffer().data();
  for (int x = 0; x < 8; ++x) {
    leaf.active[x] = leaf.leaf->valueMask().getWord<std::uint64_t>(x);
    for_each_bit(leaf.active[x], [&](int bit) {
      const float value = values[64 * x + bit];
      leaf.inside[x] |= static_cast<std::uint64_t>(value < 0.0f) << bit;
      if (!std::isfinite(value)) {
        leaf.defect = CutLeaf::Defect::kNotFinite;
        leaf.defect_node = leaf.leaf->offsetToGlobalCoord(64 * x + bit);
      }
    });
  }
  leaf.neighbors = neighbors_of(leaf.leaf->origin());
}

void CutCells::find_cuts(CutLeaf& leaf, std::uint8_t* patterns) const {
  const ForwardWords active = gather(leaf.neighbors, &CutLeaf::active);
  const ForwardWords inside = gather(leaf.neighbors, &CutLeaf::inside);
  const std::array<LoopFilling, 256>& fillings = loop_fillings();
  SliceSigns lower(active, inside, 0);
  for (int x = 0; x < 8; ++x) {
    const SliceSigns upper(active, inside, x + 1);
    leaf.cells[x] = cut_cells(lower, upper);
    leaf.edges[0][x] = lower.active[0] & upper.active[0] & (lower.inside[0] ^ upper.inside[0]);
    leaf.edges[1][x] = lower.active[0] & lower.active[1] & (lower.inside[0] ^ lower.inside[1]);
    leaf.edges[2][x] = lower.active[0] & lower.active[2] & (lower.inside[0] ^ lower.inside[2]);
    for (int axis = 0; axis < 3; ++axis) leaf.edge_count += __builtin_popcountll(leaf.edges[axis][x]);
    for_each_bit(leaf.cells[x], [&](int bit) {
      const std::uint8_t pattern = pattern_of(lower, upper, bit);
      patterns[64 * x + bit] = pattern;
      leaf.triangle_count += fillings[pattern].triangle_count;
      ++leaf.cell_count;
    });
    const std::uint64_t lacking = leaf.cells[x] & ~whole_cells(lower, upper);
    if (lacking != 0) {
      leaf.defect = CutLeaf::Defect::kNoCorner;
      leaf.defect_node = leaf.leaf->offsetToGlobalCoord(64 * x + __builtin_ctzll(lacking));
    }
    lower = upper;
  }
  check_leaves_behind(leaf);
}

/// Cells of leaves that are not there lack at least their lowest corner, so none of them may be cut.
void CutCells::check_leaves_behind(CutLeaf& leaf) const {
  for (int n = 1; n < 8; ++n) {
    if (!has_nodes_at_border(leaf.active, n)) continue;
    const Coord origin = leaf.leaf->origin() - (forward(leaf.leaf->origin(), n) - leaf.leaf->origin());
    if (index_.find(origin) != LeafIndex::none) continue;
    const Neighbors neighbors = neighbors_of(origin);
    const ForwardWords active = gather(neighbors, &CutLeaf::active);
    const ForwardWords inside = gather(neighbors, &CutLeaf::inside);
    for (int x = 0; x < 8; ++x) {
      const std::uint64_t cut = cut_cells(SliceSigns(active, inside, x), SliceSigns(active, inside, x + 1));
      if (cut == 0) continue;
      leaf.defect = CutLeaf::Defect::kNoCorner;
      leaf.defect_node = origin + openvdb::FloatTree::LeafNodeType::offsetToLocalCoord(64 * x + __builtin_ctzll(cut));
    }
  }
}

void CutCells::throw_at_defect() const {
  for (const CutLeaf& leaf : leaves_) {
    if (leaf.defect == CutLeaf::Defect::kNone) continue;
    const Coord& node = leaf.defect_node;
    if (leaf.defect == CutLeaf::Defect::kNotFinite) {
      throw TrackingError(fmt::format("The implicit function is {} at node ({}, {}, {}); check the particle positions.",
                                      leaf.leaf->getValue(node), node.x(), node.y(), node.z()));
    }
    throw TrackingError(fmt::format(
        "The isosurface passes through the cell at node ({}, {}, {}), but the implicit function is not known "
        "at all of its corners; evaluate it at every corner of every cut cell.",
        node.x(), node.y(), node.z()));
  }
}

}  // namespace particle_surface_tracker
