#include "particle_surface_tracker/core/vertex_normals.h"

#include <cmath>

#include <Eigen/Geometry>

namespace particle_surface_tracker {

std::vector<Vec3f> vertex_normals(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
  std::vector<Vec3d> sums(positions.size(), Vec3d::Zero());
  for (const Triangle& triangle : triangles) {
    Vec3d edges[3];
    for (int corner = 0; corner < 3; ++corner) {
      edges[corner] = (positions[triangle[(corner + 1) % 3]] - positions[triangle[corner]]).cast<double>();
    }
    const Vec3d normal = edges[0].cross(edges[1]);
    const double double_area = normal.norm();
    if (!(double_area > 0.0)) continue;
    for (int corner = 0; corner < 3; ++corner) {
      const double angle = std::atan2(double_area, -edges[corner].dot(edges[(corner + 2) % 3]));
      sums[triangle[corner]] += angle / double_area * normal;
    }
  }
  std::vector<Vec3f> normals(positions.size());
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const double length = sums[v].norm();
    normals[v] = length > 0.0 ? Vec3f((sums[v] / length).cast<float>()) : Vec3f::Zero();
  }
  return normals;
}

}  // namespace particle_surface_tracker
