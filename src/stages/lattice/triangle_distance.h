#pragma once

#include <array>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// Squared distance of the origin to a triangle, degenerate or not, exact up to rounding [m²].
double squared_distance_to_triangle(const std::array<Vec3d, 3>& corners);

}  // namespace particle_surface_tracker
