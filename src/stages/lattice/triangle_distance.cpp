#include "triangle_distance.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace particle_surface_tracker {

namespace {

/// Triangles whose sides are closer to each other than this, relative to their length, have no face: its normal would
/// be rounding, and the nearest side is as near.
constexpr double kThinnest = 1e-8;

double squared_distance_to_segment(const Vec3d& from, const Vec3d& to) {
  const Vec3d way = to - from;
  const double length_squared = way.squaredNorm();
  const double along = -from.dot(way);
  if (!(along > 0.0)) return from.squaredNorm();
  if (along >= length_squared) return to.squaredNorm();
  return (from + along / length_squared * way).squaredNorm();
}

}  // namespace

double squared_distance_to_triangle(const std::array<Vec3d, 3>& corners) {
  const auto& [p, q, r] = corners;
  const Vec3d first = q - p;
  const Vec3d second = r - p;
  const Vec3d normal = first.cross(second);
  const double normal_squared = normal.squaredNorm();
  if (normal_squared > kThinnest * kThinnest * first.squaredNorm() * second.squaredNorm()) {
    const bool is_over_face =
        normal.cross(first).dot(p) <= 0.0 && normal.cross(r - q).dot(q) <= 0.0 && normal.cross(-second).dot(r) <= 0.0;
    const double height = normal.dot(p);
    if (is_over_face) return height * height / normal_squared;
  }
  return std::min(
      {squared_distance_to_segment(p, q), squared_distance_to_segment(q, r), squared_distance_to_segment(r, p)});
}

}  // namespace particle_surface_tracker
