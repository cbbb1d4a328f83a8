#include "sign_flood.h"

#include "stages/nodes/leaf_index.h"
#include "stages/nodes/node_masks.h"

namespace particle_surface_tracker {

namespace {

/// Every node and its neighbours within the leaf.
LeafWords spread_within(const LeafWords& words) {
  LeafWords spread;
  for (int x = 0; x < 8; ++x) {
    const std::uint64_t word = words[x];
    spread[x] = word | word << 8 | word >> 8 | (word & ~kHighestZ) << 1 | (word & ~kLowestZ) >> 1;
    if (x > 0) spread[x] |= words[x - 1];
    if (x < 7) spread[x] |= words[x + 1];
  }
  return spread;
}

/// Moves what has arrived in `reached` on within the leaf; true if any unknown node was reached.
bool settle(LeafWords& unknown, LeafWords& reached, LeafWords arrived) {
  bool any = false;
  for (;;) {
    bool more = false;
    for (int x = 0; x < 8; ++x) {
      arrived[x] &= unknown[x];
      unknown[x] &= ~arrived[x];
      reached[x] |= arrived[x];
      more |= arrived[x] != 0;
    }
    if (!more) return any;
    any = true;
    arrived = spread_within(arrived);
  }
}

/// The nodes at the sides of a leaf whose neighbours in the next leaves are in a mask.
LeafWords arrivals(const std::vector<SignLeaf>& leaves, const SignLeaf& leaf, LeafWords SignLeaf::*mask) {
  LeafWords arrived{};
  for (int side = 0; side < 6; ++side) {
    const std::uint32_t neighbor = leaf.neighbors[side];
    if (neighbor == LeafIndex::none) continue;
    add_words(move_words(leaves[neighbor].*mask, side >> 1, side & 1 ? -1 : 1).outside, arrived);
  }
  return arrived;
}

}  // namespace

void flood_signs(std::vector<SignLeaf>& leaves) {
  std::vector<std::uint32_t> queue;
  std::vector<char> is_queued(leaves.size(), 1);
  for (std::uint32_t n = 0; n < leaves.size(); ++n) {
    settle(leaves[n].unknown, leaves[n].inside, spread_within(leaves[n].inside));
    settle(leaves[n].unknown, leaves[n].outside, spread_within(leaves[n].outside));
    queue.push_back(n);
  }
  for (std::size_t next = 0; next < queue.size(); ++next) {
    SignLeaf& leaf = leaves[queue[next]];
    is_queued[queue[next]] = 0;
    if (is_zero(leaf.unknown)) continue;
    const bool inside = settle(leaf.unknown, leaf.inside, arrivals(leaves, leaf, &SignLeaf::inside));
    const bool outside = settle(leaf.unknown, leaf.outside, arrivals(leaves, leaf, &SignLeaf::outside));
    if (!inside && !outside) continue;
    for (const std::uint32_t neighbor : leaf.neighbors) {
      if (neighbor == LeafIndex::none || is_queued[neighbor]) continue;
      is_queued[neighbor] = 1;
      queue.push_back(neighbor);
    }
  }
}

}  // namespace particle_surface_tracker
