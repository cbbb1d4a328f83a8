#include "equal_positions.h"

#include <array>
#include <cstring>
#include <utility>

#include <tbb/parallel_sort.h>

namespace particle_surface_tracker {
namespace {

/// Bits of a position as a key for sorting; −0 has those of 0.
using PositionKey = std::array<std::uint32_t, 3>;

PositionKey key_of(const Vec3f& position) {
  PositionKey key;
  for (int axis = 0; axis < 3; ++axis) {
    const float value = position[axis] == 0.0F ? 0.0F : position[axis];
    std::memcpy(&key[static_cast<std::size_t>(axis)], &value, sizeof(value));
  }
  return key;
}

}  // namespace

std::vector<std::uint32_t> first_of_same_position(const std::vector<Vec3f>& positions) {
  std::vector<std::pair<PositionKey, std::uint32_t>> order(positions.size());
  for (std::uint32_t v = 0; v < order.size(); ++v) order[v] = {key_of(positions[v]), v};
  tbb::parallel_sort(order.begin(), order.end());
  std::vector<std::uint32_t> first(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && order[i].first == order[i - 1].first;
    first[order[i].second] = is_same ? first[order[i - 1].second] : order[i].second;
  }
  return first;
}

}  // namespace particle_surface_tracker
