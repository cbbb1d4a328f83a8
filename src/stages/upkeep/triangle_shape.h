#pragma once

#include <array>
#include <vector>

#include <Eigen/Geometry>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

using Corners = std::array<Vec3d, 3>;

/// Where the corners of a triangle are.
inline Corners place_corners(const std::vector<Vec3f>& positions, const Triangle& triangle) {
  return {positions[triangle[0]].cast<double>(), positions[triangle[1]].cast<double>(),
          positions[triangle[2]].cast<double>()};
}

/// Normal of a triangle, as long as twice its area.
inline Vec3d area_normal(const Corners& corners) {
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]);
}

/// Squared lengths of the edges from corner k to the next.
inline std::array<double, 3> squared_lengths(const Corners& c) {
  return {(c[1] - c[0]).squaredNorm(), (c[2] - c[1]).squaredNorm(), (c[0] - c[2]).squaredNorm()};
}

/// Sine of the smallest angle of a triangle; 0 for a degenerate one.
double sine_of_smallest_angle(const Corners& corners);

/// Angle between the normals of two triangles [rad]: 0 where the surface is flat, π where one lies folded onto the
/// other. 0 if one of them is degenerate.
double fold_between(const Vec3d& normal, const Vec3d& other_normal);

}  // namespace particle_surface_tracker
