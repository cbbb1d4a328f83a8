#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <openvdb/Types.h>

namespace particle_surface_tracker {

/// Finds the number of a leaf of 8³ nodes by its origin. Open addressing in one array: a tree descent per neighbour
/// would cost more than the work done with it.
class LeafIndex {
 public:
  static constexpr std::uint32_t none = 0xffffffff;

  explicit LeafIndex(std::size_t expected_count) {
    std::size_t size = 16;
    while (size < 2 * expected_count) size *= 2;
    slots_.resize(size);
  }

  std::uint32_t find(const openvdb::Coord& origin) const { return slots_[slot_of(origin)].number; }

  /// Adds a leaf that is not there yet.
  void insert(const openvdb::Coord& origin, std::uint32_t number) {
    if (2 * ++count_ > slots_.size()) grow();
    slots_[slot_of(origin)] = {origin, number};
  }

 private:
  struct Slot {
    openvdb::Coord origin;
    std::uint32_t number = none;
  };

  std::size_t slot_of(const openvdb::Coord& origin) const {
    std::uint64_t h = static_cast<std::uint32_t>(origin.x() >> 3);
    h = h * 0x9E3779B97F4A7C15ull + static_cast<std::uint32_t>(origin.y() >> 3);
    h = h * 0x9E3779B97F4A7C15ull + static_cast<std::uint32_t>(origin.z() >> 3);
    h *= 0x9E3779B97F4A7C15ull;
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = (h >> 32) & mask;
    while (slots_[slot].number != none && slots_[slot].origin != origin) slot = (slot + 1) & mask;
    return slot;
  }

  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.number != none) slots_[slot_of(slot.origin)] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::size_t count_ = 0;
};

}  // namespace particle_surface_tracker
