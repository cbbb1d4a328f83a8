#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "half_edges.h"
#include "particle_surface_tracker/core/triangle_mesh.h"
#include "tolerances.h"

namespace particle_surface_tracker {

/// What calls for an operation, in the order in which it is dealt with.
enum class Ailment : std::uint8_t { kLongEdge, kShortEdge, kFoldedEdge, kSliver };

/// An edge that calls for an operation, or the shortest edge of a triangle that does.
struct Candidate {
  Ailment ailment;
  double urgency;           ///< Larger ones come first.
  std::uint32_t low, high;  ///< Vertices of the edge when this was found; they settle ties.
  std::uint32_t half_edge;
  Vec3f position = Vec3f::Zero();  ///< Where a long edge is to be split [m].

  /// Whether another one of the same ailment is more urgent.
  bool operator<(const Candidate& other) const;
};

/// A mesh whose connectivity may be ahead of what TriangleMesh has stored.
struct SurfaceView {
  const std::vector<Vec3f>& positions;
  const std::vector<Triangle>& triangles;
  const std::vector<std::uint32_t>& twins;

  Corners corners(std::uint32_t triangle) const { return place_corners(positions, triangles[triangle]); }
  /// An edge is named by the lower of its half-edges.
  bool is_name_of_edge(std::uint32_t half_edge) const { return half_edge < twins[half_edge]; }
  std::uint32_t shortest_edge(std::uint32_t triangle) const;
  std::uint32_t longest_edge(std::uint32_t triangle) const;
};

/// Calls visit(ailment, urgency, half_edge) for everything that ails a triangle and its edges.
/// \param is_asked about which half-edges of the triangle: is_asked(half_edge).
template <typename IsAsked, typename Visit>
void for_each_ailment(const SurfaceView& surface, std::uint32_t triangle, const Tolerances& tolerances,
                      IsAsked&& is_asked, Visit&& visit) {
  const Triangle& vertices = surface.triangles[triangle];
  const Corners corners = surface.corners(triangle);
  const Vec3d normal = area_normal(corners);
  const std::array<double, 3> squares = squared_lengths(corners);
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t h = 3 * triangle + k;
    if (!is_asked(h)) continue;
    const std::uint32_t a = vertices[k], b = vertices[(k + 1) % 3];
    if (tolerances.is_long(a, b, squares[k])) visit(Ailment::kLongEdge, squares[k], h);
    if (tolerances.is_short(a, b, squares[k])) visit(Ailment::kShortEdge, -squares[k], h);
    const Vec3d normal_beyond = area_normal(surface.corners(surface.twins[h] / 3));
    if (tolerances.is_folded(a, b, normal, normal_beyond)) {
      visit(Ailment::kFoldedEdge, fold_between(normal, normal_beyond), h);
    }
  }
  if (!tolerances.may_be_sliver(normal, squares)) return;
  const double sine = sine_of_smallest_angle(corners);
  if (tolerances.is_sliver(vertices, sine)) visit(Ailment::kSliver, -sine, surface.shortest_edge(triangle));
}

/// Whether a candidate still has its ailment, just as urgently: what for_each_ailment() would say of its half-edge.
bool still_ails(const SurfaceView& surface, const Candidate& candidate, const Tolerances& tolerances);

}  // namespace particle_surface_tracker
