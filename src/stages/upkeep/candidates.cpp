#include "candidates.h"

#include <algorithm>
#include <tuple>

namespace particle_surface_tracker {

bool Candidate::operator<(const Candidate& other) const {
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

bool still_ails(const SurfaceView& surface, const Candidate& candidate, const Tolerances& tolerances) {
  const std::uint32_t h = candidate.half_edge, triangle = h / 3;
  const Triangle& vertices = surface.triangles[triangle];
  const std::uint32_t a = vertices[h % 3], b = vertices[next_half_edge(h) % 3];
  if (std::min(a, b) != candidate.low || std::max(a, b) != candidate.high) return false;
  const Corners corners = surface.corners(triangle);
  if (candidate.ailment == Ailment::kSliver) {
    if (!tolerances.may_be_sliver(area_normal(corners), squared_lengths(corners))) return false;
    const double sine = sine_of_smallest_angle(corners);
    return -sine == candidate.urgency && tolerances.is_sliver(vertices, sine) && surface.shortest_edge(triangle) == h;
  }
  if (!surface.is_name_of_edge(h)) return false;
  if (candidate.ailment == Ailment::kFoldedEdge) {
    const Vec3d normal = area_normal(corners), beyond = area_normal(surface.corners(surface.twins[h] / 3));
    return tolerances.is_folded(a, b, normal, beyond) && fold_between(normal, beyond) == candidate.urgency;
  }
  const double square = squared_lengths(corners)[h % 3];
  if (candidate.ailment == Ailment::kLongEdge) return square == candidate.urgency && tolerances.is_long(a, b, square);
  return -square == candidate.urgency && tolerances.is_short(a, b, square);
}

}  // namespace particle_surface_tracker
