#pragma once

#include <array>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

// Exact signs for a mesh that is moved by (εx, εy, εz), εx ≫ εy ≫ εz > 0, against a lattice that is not. Each of these
// is linear in the motion, so where it is 0 without it, the first component that changes it decides.

/// The corners of a triangle.
using Corners = std::array<const Vec3f*, 3>;

/// On which side of the mesh edge p → q, seen in the plane of axes a and b, the lattice line through (plane_a, plane_b)
/// lies: +1 where turning from axis a to axis b leads, −1 on the other side; 0 only where p and q coincide in that
/// view. Swapping p and q, or a and b, changes the sign.
int side_of_edge(const Vec3f& p, const Vec3f& q, int a, int b, double plane_a, double plane_b);

/// On which side of a triangle's plane a node lies: +1 in front, −1 behind; 0 only where the triangle is degenerate.
int side_of_triangle(const Corners& corners, const Vec3d& node);

/// A triangle that a lattice line crosses.
struct CrossedTriangle {
  Corners corners;
  int facing;  ///< Sign of the normal's component along the line.
};

/// Order of two triangles along a lattice line that crosses both: −1 where the first one is crossed first, +1 where it
/// is the second one, 0 where they lie in one plane.
/// \param node any on the line.
int compare_along_line(const CrossedTriangle& first, const CrossedTriangle& second, int axis, const Vec3d& node);

}  // namespace particle_surface_tracker
