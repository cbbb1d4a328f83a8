#include "surroundings.h"

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
  entries_.reserve(surface.triangle_slots() + surface.triangle_slots() / 8);
  for (std::uint32_t t = 0; t < surface.triangle_slots(); ++t) enter(t);
}

void Surroundings::enter(std::uint32_t triangle) {
  Eigen::AlignedBox3f box;
  for (const std::uint32_t vertex : surface_.triangle(triangle)) box.extend(surface_.stored_position(vertex));
  const double extent = box.sizes().maxCoeff();
  std::size_t level = 0;
  while (level + 1 < kLevels && extent * inverse_cell_size_[level] > 1.0) ++level;
  level_in_use_[level] = true;
  const Cell cell = cell_of(box.min(), level);
  const std::size_t slot = slot_of(row_of(cell[1], cell[2], level), cell[0]);
  entries_.push_back({box, triangle, heads_[slot]});
  heads_[slot] = static_cast<std::uint32_t>(entries_.size() - 1);
}

bool Surroundings::has_more_cells_than_entries(const Cell& first, const Cell& last) const {
  double cells = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) cells *= static_cast<double>(last[axis] - first[axis]) + 2.0;
  return cells > static_cast<double>(entries_.size());
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

std::uint64_t Surroundings::row_of(std::int64_t y, std::int64_t z, std::size_t level) {
  auto hash = static_cast<std::uint64_t>(level);
  for (const std::int64_t coordinate : {y, z}) {
    hash = (hash ^ static_cast<std::uint64_t>(coordinate)) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 32;
  }
  return hash;
}

}  // namespace particle_surface_tracker
