#pragma once

#include <array>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

using Corners = std::array<Vec3d, 3>;

/// Normal of a triangle, as long as twice its area.
Vec3d area_normal(const Corners& corners);

/// Sine of the smallest angle of a triangle; 0 for a degenerate one.
double sine_of_smallest_angle(const Corners& corners);

/// Angle between the normals of two triangles [rad]: 0 where the surface is flat, π where one lies folded onto the
/// other. 0 if one of them is degenerate.
double fold_between(const Vec3d& normal, const Vec3d& other_normal);

}  // namespace particle_surface_tracker
