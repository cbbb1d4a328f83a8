#include "triangle_shape.h"

#include <algorithm>
#include <cmath>

namespace particle_surface_tracker {

double sine_of_smallest_angle(const Corners& corners) {
  std::array<double, 3> squares = squared_lengths(corners);
  std::sort(squares.begin(), squares.end());
  if (squares[1] == 0.0) return 0.0;
  // The smallest angle lies between the two longer edges.
  return std::sqrt(area_normal(corners).squaredNorm() / (squares[1] * squares[2]));
}

double fold_between(const Vec3d& normal, const Vec3d& other_normal) {
  return std::atan2(normal.cross(other_normal).norm(), normal.dot(other_normal));
}

}  // namespace particle_surface_tracker
