#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace particle_surface_tracker {

/// Integer coordinates of a cell or node of a world-anchored lattice.
using LatticeCoord = std::array<std::int32_t, 3>;

/// Finds the number of a part of a lattice by its coordinates. Open addressing in one array, which is several times
/// faster than std::unordered_map where most questions come one by one.
class LatticeIndex {
 public:
  static constexpr std::uint32_t none = 0xffffffff;

  LatticeIndex() : slots_(64) {}

  std::uint32_t find(const LatticeCoord& coord) const { return slots_[slot_of(coord)].number; }

  /// The number of a part; one that is not there yet gets the next number, which is the count of parts before.
  std::uint32_t find_or_insert(const LatticeCoord& coord) {
    std::size_t slot = slot_of(coord);
    if (slots_[slot].number != none) return slots_[slot].number;
    if (2 * (count_ + 1) > slots_.size()) {
      grow();
      slot = slot_of(coord);
    }
    slots_[slot] = {coord, count_};
    return count_++;
  }

  /// Gives a part that is there another number.
  void renumber(const LatticeCoord& coord, std::uint32_t number) { slots_[slot_of(coord)].number = number; }

 private:
  struct Slot {
    LatticeCoord coord = {};
    std::uint32_t number = none;
  };

  std::size_t slot_of(const LatticeCoord& c) const {
    std::uint64_t h = static_cast<std::uint32_t>(c[0]);
    h = h * 0x9E3779B97F4A7C15ull + static_cast<std::uint32_t>(c[1]);
    h = h * 0x9E3779B97F4A7C15ull + static_cast<std::uint32_t>(c[2]);
    h *= 0x9E3779B97F4A7C15ull;
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = (h >> 32) & mask;
    while (slots_[slot].number != none && !is_same(slots_[slot].coord, c)) slot = (slot + 1) & mask;
    return slot;
  }

  /// The comparison of arrays is a call of memcmp.
  static bool is_same(const LatticeCoord& a, const LatticeCoord& b) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
  }

  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old) {
      if (slot.number != none) slots_[slot_of(slot.coord)] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::uint32_t count_ = 0;
};

}  // namespace particle_surface_tracker
