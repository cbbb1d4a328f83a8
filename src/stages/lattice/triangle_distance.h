#pragma once

#include <array>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// Squared distance of the origin to a triangle, degenerate or not, exact up to rounding [m²].
double squared_distance_to_triangle(const std::array<Vec3d, 3>& corners);

/// Squared distance of the origin to the bounding box of a triangle [m²].
inline double squared_distance_to_box(const std::array<Vec3d, 3>& corners) {
  const Vec3d below = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
  const Vec3d above = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
  return below.cwiseMax(-above).cwiseMax(0.0).squaredNorm();
}

}  // namespace particle_surface_tracker
