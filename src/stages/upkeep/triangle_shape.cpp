#include "triangle_shape.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace particle_surface_tracker {

Vec3d area_normal(const Corners& corners) {
  return (corners[1] - corners[0]).cross(corners[2] - corners[0]);
}

double sine_of_smallest_angle(const Corners& corners) {
  std::array<double, 3> squares = {(corners[1] - corners[0]).squaredNorm(), (corners[2] - corners[1]).squaredNorm(),
                                   (corners[0] - corners[2]).squaredNorm()};
  std::sort(squares.begin(), squares.end());
  if (squares[1] == 0.0) return 0.0;
  // The smallest angle lies between the two longer edges.
  return std::sqrt(area_normal(corners).squaredNorm() / (squares[1] * squares[2]));
}

double fold_between(const Vec3d& normal, const Vec3d& other_normal) {
  return std::atan2(normal.cross(other_normal).norm(), normal.dot(other_normal));
}

}  // namespace particle_surface_tracker
