#include "candidates.h"

#include <algorithm>
#include <tuple>

namespace particle_surface_tracker {

bool Candidate::operator<(const Candidate& other) const {
  if (ailment != other.ailment) return ailment > other.ailment;
  if (urgency != other.urgency) return urgency < other.urgency;
  return std::tie(low, high, half_edge) > std::tie(other.low, other.high, other.half_edge);
}

std::uint32_t SurfaceView::shortest_edge(std::uint32_t triangle) const {
  const auto squares = squared_lengths(corners(triangle));
  return 3 * triangle + static_cast<std::uint32_t>(std::min_element(squares.begin(), squares.end()) - squares.begin());
}

std::uint32_t SurfaceView::longest_edge(std::uint32_t triangle) const {
  const auto squares = squared_lengths(corners(triangle));
  return 3 * triangle + static_cast<std::uint32_t>(std::max_element(squares.begin(), squares.end()) - squares.begin());
}

}  // namespace particle_surface_tracker
