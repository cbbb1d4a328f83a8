#include "node_masks.h"

#include <algorithm>
#include <utility>

namespace particle_surface_tracker {

namespace {

constexpr int kWidth = 8;

}  // namespace

bool is_zero(const LeafWords& words) {
  return std::all_of(words.begin(), words.end(), [](std::uint64_t word) { return word == 0; });
}

MovedWords move_words(const LeafWords& words, int axis, int direction) {
  MovedWords moved;
  for (int x = 0; x < kWidth; ++x) {
    const std::uint64_t word = words[x];
    if (axis == 0) {
      const int to = x + direction;
      (to < 0 || to >= kWidth ? moved.outside : moved.inside)[to & (kWidth - 1)] = word;
    } else if (axis == 1) {
      moved.inside[x] = direction > 0 ? word << 8 : word >> 8;
      moved.outside[x] = direction > 0 ? word >> 56 : word << 56;
    } else {
      moved.inside[x] = direction > 0 ? (word & ~kHighestZ) << 1 : (word & ~kLowestZ) >> 1;
      moved.outside[x] = direction > 0 ? (word & kHighestZ) >> 7 : (word & kLowestZ) << 7;
    }
  }
  return moved;
}

bool NodeMasks::contains(const openvdb::Coord& node) const {
  const std::uint32_t leaf = find(node & ~7);
  if (leaf == LeafIndex::none) return false;
  return (leaves_[leaf].words[node.x() & 7] >> (8 * (node.y() & 7) + (node.z() & 7)) & 1) != 0;
}

void NodeMasks::dilate(int down, int up) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int step = 0; step < std::max(down, up); ++step) {
      if (step < down) dilate_by_one(axis, -1);
      if (step < up) dilate_by_one(axis, +1);
    }
  }
}

void NodeMasks::dilate_by_one(int axis, int direction) {
  const std::size_t count = leaves_.size();
  openvdb::Coord offset(0);
  offset[axis] = direction * kWidth;
  // What moves into a neighbour must not move on within the same step, so it waits until every leaf has moved.
  std::vector<std::pair<openvdb::Coord, LeafWords>> arrivals;
  for (std::size_t n = 0; n < count; ++n) {
    Leaf& leaf = leaves_[n];
    const MovedWords moved = move_words(leaf.words, axis, direction);
    for (int x = 0; x < kWidth; ++x) leaf.words[x] |= moved.inside[x];
    if (!is_zero(moved.outside)) arrivals.emplace_back(leaf.origin + offset, moved.outside);
  }
  for (const auto& [origin, words] : arrivals) {
    LeafWords& target = words_at(origin);
    for (int x = 0; x < kWidth; ++x) target[x] |= words[x];
  }
}

}  // namespace particle_surface_tracker
