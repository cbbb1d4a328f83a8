#pragma once

#include <array>
#include <cmath>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

// Exact signs for a mesh that is moved by (εx, εy, εz), εx ≫ εy ≫ εz > 0, against a lattice that is not. Each of these
// is linear in the motion, so where it is 0 without it, the first component that changes it decides.

/// The corners of a triangle.
using Corners = std::array<const Vec3f*, 3>;

/// On which side of the mesh edge p → q, seen in the plane of axes a and b, the lattice line through (plane_a, plane_b)
/// lies: +1 where turning from axis a to axis b leads, −1 on the other side; 0 only where p and q coincide in that
/// view. Swapping p and q, or a and b, changes the sign.
inline int side_of_edge(const Vec3f& p, const Vec3f& q, int a, int b, double plane_a, double plane_b);

/// The same where rounding may have the wrong sign, or where it is 0 before the motion.
int doubtful_side_of_edge(const Vec3f& p, const Vec3f& q, int a, int b, double plane_a, double plane_b);

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

int side_of_edge(const Vec3f& p, const Vec3f& q, int a, int b, double plane_a, double plane_b) {
  // Bound of the rounding error of a 2 × 2 determinant of differences, relative to the absolute values of its terms
  // (Shewchuk 1997).
  constexpr double kError = (3.0 + 16.0 * 0x1p-53) * 0x1p-53;
  const double left = (static_cast<double>(q[a]) - p[a]) * (plane_b - p[b]);
  const double right = (static_cast<double>(q[b]) - p[b]) * (plane_a - p[a]);
  const double determinant = left - right;
  const double bound = kError * (std::abs(left) + std::abs(right));
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  return doubtful_side_of_edge(p, q, a, b, plane_a, plane_b);
}

}  // namespace particle_surface_tracker
