#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace particle_surface_tracker {

/// Numbers 0, 1, … in sets that can be joined: a forest with one tree for each set. Parents are never above their
/// children, so the root of a tree is the lowest number of its set, in whatever order sets were joined.
class DisjointSets {
 public:
  /// Every number in a set of its own.
  explicit DisjointSets(std::size_t size) : parents_(size), count_(size) {
    std::iota(parents_.begin(), parents_.end(), 0U);
  }

  /// How many sets there are.
  std::size_t count() const { return count_; }

  /// The root of a set; every number passed on the way is hung one step higher.
  std::uint32_t find(std::uint32_t number) {
    while (parents_[number] != number) {
      parents_[number] = parents_[parents_[number]];
      number = parents_[number];
    }
    return number;
  }

  /// Whether two numbers are seen to be in one set without a search.
  bool have_same_parent(std::uint32_t a, std::uint32_t b) const { return parents_[a] == parents_[b]; }

  /// \return the root of the set of both.
  std::uint32_t join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t first = find(a), second = find(b);
    if (first == second) return first;
    --count_;
    const auto [low, high] = std::minmax(first, second);
    parents_[high] = low;
    return low;
  }

  /// The number of the set of each number: sets are counted from 0 by their lowest number.
  std::vector<std::uint32_t> labels() const {
    std::vector<std::uint32_t> labels(parents_.size());
    std::uint32_t next = 0;
    // A parent comes before its children, so it has its label when they ask for it.
    for (std::uint32_t n = 0; n < labels.size(); ++n) labels[n] = parents_[n] == n ? next++ : labels[parents_[n]];
    return labels;
  }

 private:
  std::vector<std::uint32_t> parents_;
  std::size_t count_;
};

}  // namespace particle_surface_tracker
