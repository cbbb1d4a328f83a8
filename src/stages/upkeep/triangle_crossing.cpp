#include "triangle_crossing.h"

#include <algorithm>
#include <limits>

#include "triangle_overlap.h"

namespace particle_surface_tracker {

namespace {

/// A bound on the relative error of a height above a plane.
constexpr double kRounding = 1e-13;

/// Whether all corners of a triangle but one are on one side of the plane of another one, by more than rounding can be
/// wrong. Most triangles next to each other can be told apart so, at a small part of the price.
/// \param ignored a corner of the triangle that lies in the plane; 3: none.
/// \param in_plane corner of the other one to measure from.
bool lies_beside(const Corners& triangle, std::size_t ignored, const PlacedTriangle& plane, std::size_t in_plane) {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest(), farthest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (k == ignored) continue;
    const Vec3d offset = triangle[k] - plane.corners[in_plane];
    const double height = plane.normal.dot(offset);
    low = std::min(low, height);
    high = std::max(high, height);
    farthest = std::max(farthest, offset.squaredNorm());
  }
  const double distance = std::max(low, -high);
  return distance > 0.0 && distance * distance > kRounding * kRounding * plane.normal.squaredNorm() * farthest;
}

Corners rotated(const Corners& c, std::size_t by) {
  return {c[by], c[(by + 1) % 3], c[(by + 2) % 3]};
}

}  // namespace

bool triangles_cross(const PlacedTriangle& a, const PlacedTriangle& b) {
  std::size_t shared = 0, in_a = 0, in_b = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (a.vertices[i] != b.vertices[j]) continue;
      ++shared;
      in_a = i;
      in_b = j;
    }
  }
  if (shared > 1) return false;
  const bool is_apart = shared == 0;
  if (lies_beside(b.corners, is_apart ? 3 : in_b, a, in_a) || lies_beside(a.corners, is_apart ? 3 : in_a, b, in_b)) {
    return false;
  }
  if (is_apart) return triangles_touch(a.corners, b.corners);
  return triangles_cross_at_shared_corner(rotated(a.corners, in_a), rotated(b.corners, in_b));
}

}  // namespace particle_surface_tracker
