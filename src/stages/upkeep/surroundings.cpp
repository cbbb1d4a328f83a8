#include "surroundings.h"

#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace particle_surface_tracker {

Surroundings::Surroundings(const EditableSurface& surface, double smallest_cell) : surface_(surface) {
  double size = smallest_cell;
  for (double& inverse : inverse_cell_size_) {
    inverse = 1.0 / size;
    size *= 2.0;
  }
  std::size_t slots = 1024;
  while (slots < surface.triangle_slots()) slots *= 2;
  heads_.assign(slots, kEnd);
  enter_first();
}

void Surroundings::enter_first() {
  std::vector<Placed> all(surface_.triangle_slots());
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, surface_.triangle_slots(), 4096), [&](const auto& range) {
    for (std::uint32_t t = range.begin(); t != range.end(); ++t) {
      if (surface_.is_alive(t)) all[t] = placed(t);
    }
  });
  begins_.assign(heads_.size() + 2, 0);
  for (std::uint32_t t = 0; t < all.size(); ++t) {
    if (!surface_.is_alive(t)) continue;
    level_in_use_[all[t].level] = true;
    ++begins_[all[t].slot + 2];
  }
  for (std::size_t slot = 2; slot < begins_.size(); ++slot) begins_[slot] += begins_[slot - 1];
  first_entries_.resize(begins_.back());
  for (std::uint32_t t = 0; t < all.size(); ++t) {
    if (surface_.is_alive(t)) first_entries_[begins_[all[t].slot + 1]++] = all[t].entry;
  }
  begins_.pop_back();
}

Surroundings::Placed Surroundings::placed(std::uint32_t triangle) const {
  Placed result{};
  Eigen::AlignedBox3f& box = result.entry.box;
  box.setEmpty();
  for (const std::uint32_t vertex : surface_.triangle(triangle)) box.extend(surface_.stored_position(vertex));
  result.entry.triangle = triangle;
  const double extent = box.sizes().maxCoeff();
  while (result.level + 1 < kLevels && extent * inverse_cell_size_[result.level] > 1.0) ++result.level;
  const Cell cell = cell_of(box.min(), result.level);
  result.slot = slot_of(row_of(cell[1], cell[2], result.level), cell[0]);
  return result;
}

void Surroundings::enter(std::uint32_t triangle) {
  const Placed entered = placed(triangle);
  level_in_use_[entered.level] = true;
  later_entries_.push_back({entered.entry, heads_[entered.slot]});
  heads_[entered.slot] = static_cast<std::uint32_t>(later_entries_.size() - 1);
}

bool Surroundings::has_more_cells_than_entries(const Cell& first, const Cell& last) const {
  double cells = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) cells *= static_cast<double>(last[axis] - first[axis]) + 2.0;
  return cells > static_cast<double>(first_entries_.size() + later_entries_.size());
}

Surroundings::Cell Surroundings::cell_of(const Vec3f& position, std::size_t level) const {
  const Vec3d scaled = position.cast<double>() * inverse_cell_size_[level];
  return {static_cast<std::int64_t>(std::floor(scaled.x())), static_cast<std::int64_t>(std::floor(scaled.y())),
          static_cast<std::int64_t>(std::floor(scaled.z()))};
}

std::uint64_t Surroundings::row_of(std::int64_t y, std::int64_t z, std::size_t level) {
  auto hash = static_cast<std::uint64_t>(level);
  for (const std::int64_t coordinate : {y, z}) {
    hash = (hash ^ static_cast<std::uint64_t>(coordinate)) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 32;
  }
  return hash;
}

}  // namespace particle_surface_tracker
