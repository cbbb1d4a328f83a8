#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace particle_surface_tracker::test {

/// Sets of numbers that are merged, and asked for a common representative.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t find(std::uint32_t a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
  }
  void merge(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace particle_surface_tracker::test
