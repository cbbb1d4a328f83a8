#include "node_numbers.h"

#include <algorithm>

namespace particle_surface_tracker {

namespace {

constexpr int kWidth = 8;

/// Of leaves sorted by origin from `begin` on, the end of those with the same origin along x and, if wanted, y.
std::size_t end_of_equal(const std::vector<std::uint32_t>& order, const std::vector<NodeMasks::Leaf>& leaves,
                         std::size_t begin, std::size_t end, int axis) {
  const int origin = leaves[order[begin]].origin[axis];
  while (begin < end && leaves[order[begin]].origin[axis] == origin) ++begin;
  return begin;
}

}  // namespace

NodeNumbers::NodeNumbers(const NodeMasks& set) : index_(set.leaves().size()) {
  const std::vector<NodeMasks::Leaf>& leaves = set.leaves();
  std::vector<std::uint32_t> order(leaves.size());
  numbers_.resize(leaves.size());
  for (std::uint32_t n = 0; n < leaves.size(); ++n) {
    order[n] = n;
    index_.insert(leaves[n].origin, n);
    numbers_[n].fill(none);
  }
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return leaves[a].origin < leaves[b].origin; });
  for (std::size_t slab = 0; slab < order.size();) {
    const std::size_t slab_end = end_of_equal(order, leaves, slab, order.size(), 0);
    for (int x = 0; x < kWidth; ++x) {
      for (std::size_t row = slab; row < slab_end;) {
        const std::size_t row_end = end_of_equal(order, leaves, row, slab_end, 1);
        for (int y = 0; y < kWidth; ++y) {
          for (std::size_t n = row; n < row_end; ++n) {
            const NodeMasks::Leaf& leaf = leaves[order[n]];
            for_each_bit(leaf.words[x] >> (kWidth * y) & 0xff, [&](int z) {
              numbers_[order[n]][64 * x + kWidth * y + z] = static_cast<std::uint32_t>(nodes_.size());
              nodes_.push_back(leaf.origin.offsetBy(x, y, z));
            });
          }
        }
        row = row_end;
      }
    }
    slab = slab_end;
  }
}

}  // namespace particle_surface_tracker
