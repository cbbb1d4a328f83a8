#include "surroundings.h"

#include <utility>

namespace particle_surface_tracker {

Surroundings::Surroundings(const EditableSurface& surface, double smallest_cell) : surface_(surface) {
  double size = smallest_cell;
  for (double& inverse : inverse_cell_size_) {
    inverse = 1.0 / size;
    size *= 2.0;
  }
  const auto count = static_cast<std::uint32_t>(surface.triangle_slots());
  std::size_t slots = 1024;
  while (slots < count) slots *= 2;
  block_mask_ = (slots >> (3 * kBlockBits)) - 1;
  slots_.assign(slots + 1, {0, kEnd});

  std::vector<Place> places;
  places.reserve(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    const Place& place = places.emplace_back(place_of(t));
    level_in_use_[place.level] = true;
    ++slots_[place.slot].begin;
  }
  std::uint32_t begin = 0;
  for (Slot& slot : slots_) begin += std::exchange(slot.begin, begin);
  first_entries_.resize(count);
  last_entries_.reserve(count);
  for (const Place& place : places) {
    const std::uint32_t index = slots_[place.slot].begin++;
    first_entries_[index] = place.entry;
    last_entries_.push_back({place.slot, index});
  }
  // That left every begin where the next slot begins; the last one never moved.
  for (std::size_t slot = slots; slot > 0; --slot) slots_[slot].begin = slots_[slot - 1].begin;
  slots_.front().begin = 0;
}

void Surroundings::enter(std::uint32_t triangle) {
  const Place place = place_of(triangle);
  level_in_use_[place.level] = true;
  if (triangle < last_entries_.size() && last_entries_[triangle].slot == place.slot) {
    entry_at(last_entries_[triangle].index) = place.entry;
    return;
  }
  if (triangle >= last_entries_.size()) last_entries_.resize(triangle + 1, {kEnd, kEnd});
  last_entries_[triangle] = {place.slot, static_cast<std::uint32_t>(first_entries_.size() + later_entries_.size())};
  std::uint32_t& later = slots_[place.slot].later;
  later_entries_.push_back({place.entry, later});
  later = static_cast<std::uint32_t>(later_entries_.size() - 1);
}

Surroundings::Place Surroundings::place_of(std::uint32_t triangle) const {
  Eigen::AlignedBox3f box;
  for (const std::uint32_t vertex : surface_.triangle(triangle)) box.extend(surface_.stored_position(vertex));
  const double extent = box.sizes().maxCoeff();
  std::uint32_t level = 0;
  while (level + 1 < kLevels && extent * inverse_cell_size_[level] > 1.0) ++level;
  const Cell cell = cell_of(box.min(), level);
  const Cell block = {cell[0] >> kBlockBits, cell[1] >> kBlockBits, cell[2] >> kBlockBits};
  return {
      {PackedBox(box), triangle}, level, static_cast<std::uint32_t>(first_slot_of(block, level) + slot_in_block(cell))};
}

Surroundings::Entry& Surroundings::entry_at(std::uint32_t index) {
  const auto first_later = static_cast<std::uint32_t>(first_entries_.size());
  return index < first_later ? first_entries_[index] : later_entries_[index - first_later].entry;
}

bool Surroundings::has_more_cells_than_entries(const Cell& first, const Cell& last) const {
  double cells = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) cells *= static_cast<double>(last[axis] - first[axis]) + 2.0;
  return cells > static_cast<double>(first_entries_.size() + later_entries_.size());
}

Surroundings::Cell Surroundings::cell_of(const Vec3f& position, std::size_t level) const {
  Cell cell;
  for (int axis = 0; axis < 3; ++axis) {
    // std::floor() is a function call on plain x86-64.
    const double scaled = static_cast<double>(position[axis]) * inverse_cell_size_[level];
    const auto truncated = static_cast<std::int64_t>(scaled);
    cell[axis] = truncated - (scaled < static_cast<double>(truncated) ? 1 : 0);
  }
  return cell;
}

std::size_t Surroundings::first_slot_of(const Cell& block, std::size_t level) const {
  auto hash = static_cast<std::uint64_t>(level);
  for (const std::int64_t coordinate : block) {
    hash = (hash ^ static_cast<std::uint64_t>(coordinate)) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 32;
  }
  return (hash & block_mask_) << (3 * kBlockBits);
}

std::size_t Surroundings::slot_in_block(const Cell& cell) {
  std::size_t slot = 0;
  for (std::size_t axis = 3; axis-- > 0;) {
    slot = (slot << kBlockBits) | static_cast<std::size_t>(cell[axis] & (kBlockSide - 1));
  }
  return slot;
}

}  // namespace particle_surface_tracker
