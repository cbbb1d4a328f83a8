#include "node_masks.h"

#include <algorithm>
#include <utility>

namespace particle_surface_tracker {

namespace {

constexpr int kWidth = 8;

/// The nodes of a slice with the lowest z.
constexpr std::uint64_t lowest_z(int count) {
  return kLowestZ * ((std::uint64_t{1} << count) - 1);
}

}  // namespace

bool is_zero(const LeafWords& words) {
  return std::all_of(words.begin(), words.end(), [](std::uint64_t word) { return word == 0; });
}

MovedWords move_words(const LeafWords& words, int axis, int direction, int distance) {
  const int kept = kWidth - distance;
  const std::uint64_t kept_z = lowest_z(direction > 0 ? kept : distance);
  MovedWords moved;
  for (int x = 0; x < kWidth; ++x) {
    const std::uint64_t word = words[x];
    if (axis == 0) {
      const int to = x + direction * distance;
      (to < 0 || to >= kWidth ? moved.outside : moved.inside)[to & (kWidth - 1)] = word;
    } else if (axis == 1) {
      if (kept > 0) moved.inside[x] = direction > 0 ? word << kWidth * distance : word >> kWidth * distance;
      moved.outside[x] = direction > 0 ? word >> kWidth * kept : word << kWidth * kept;
    } else if (direction > 0) {
      moved.inside[x] = (word & kept_z) << distance;
      moved.outside[x] = (word & ~kept_z) >> kept;
    } else {
      moved.inside[x] = (word & ~kept_z) >> distance;
      moved.outside[x] = (word & kept_z) << kept;
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
    for (const int direction : {-1, +1}) {
      const int wanted = direction < 0 ? down : up;
      // What covers n nodes in a row covers twice as many with a copy of itself.
      for (int covered = 0; covered < wanted;) {
        const int distance = std::min({covered + 1, wanted - covered, kWidth});
        add_moved(axis, direction, distance);
        covered += distance;
      }
    }
  }
}

void NodeMasks::add_moved(int axis, int direction, int distance) {
  const std::size_t count = leaves_.size();
  openvdb::Coord offset(0);
  offset[axis] = direction * kWidth;
  // What moves into a neighbour must not move on within the same step, so it waits until every leaf has moved.
  std::vector<std::pair<openvdb::Coord, LeafWords>> arrivals;
  for (std::size_t n = 0; n < count; ++n) {
    Leaf& leaf = leaves_[n];
    const MovedWords moved = move_words(leaf.words, axis, direction, distance);
    add_words(moved.inside, leaf.words);
    if (!is_zero(moved.outside)) arrivals.emplace_back(leaf.origin + offset, moved.outside);
  }
  for (const auto& [origin, words] : arrivals) add_words(words, words_at(origin));
}

NodeMasks nodes_beside(const NodeMasks& set) {
  NodeMasks beside(set.leaves().size());
  for (const NodeMasks::Leaf& leaf : set.leaves()) {
    if (is_zero(leaf.words)) continue;
    for (int side = 0; side < 6; ++side) {
      const int direction = side % 2 == 0 ? -1 : 1;
      const MovedWords moved = move_words(leaf.words, side / 2, direction);
      add_words(moved.inside, beside.words_at(leaf.origin));
      if (is_zero(moved.outside)) continue;
      openvdb::Coord beyond = leaf.origin;
      beyond[side / 2] += direction * kWidth;
      add_words(moved.outside, beside.words_at(beyond));
    }
  }
  return beside;
}

}  // namespace particle_surface_tracker
