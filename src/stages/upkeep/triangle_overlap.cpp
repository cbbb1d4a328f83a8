#include "triangle_overlap.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace particle_surface_tracker {

namespace {

/// Whether the projections onto an axis have a gap between them that rounding cannot have made.
bool separates(const Vec3d& axis, const Corners& a, const Corners& b) {
  const Vec3d along_a(axis.dot(a[0]), axis.dot(a[1]), axis.dot(a[2]));
  const Vec3d along_b(axis.dot(b[0]), axis.dot(b[1]), axis.dot(b[2]));
  const double gap = std::max(along_b.minCoeff() - along_a.maxCoeff(), along_a.minCoeff() - along_b.maxCoeff());
  constexpr double rounding = 1e-14;
  return gap > rounding * std::max(along_a.cwiseAbs().maxCoeff(), along_b.cwiseAbs().maxCoeff());
}

Corners edges_of(const Corners& t) {
  return {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
}

}  // namespace

bool triangles_touch(const Corners& first, const Corners& second) {
  // Near the origin the projections are rounded least.
  const Corners a = {Vec3d::Zero(), first[1] - first[0], first[2] - first[0]};
  const Corners b = {second[0] - first[0], second[1] - first[0], second[2] - first[0]};
  const Corners edges_a = edges_of(a), edges_b = edges_of(b);
  const Vec3d normal_a = edges_a[0].cross(edges_a[1]), normal_b = edges_b[0].cross(edges_b[1]);
  if (separates(normal_a, a, b) || separates(normal_b, a, b)) return false;
  for (const Vec3d& edge_a : edges_a) {
    for (const Vec3d& edge_b : edges_b) {
      if (separates(edge_a.cross(edge_b), a, b)) return false;
    }
  }
  // Triangles of one plane.
  for (const Vec3d& edge : edges_a) {
    if (separates(normal_a.cross(edge), a, b) || separates(normal_b.cross(edge), a, b)) return false;
  }
  for (const Vec3d& edge : edges_b) {
    if (separates(normal_a.cross(edge), a, b) || separates(normal_b.cross(edge), a, b)) return false;
  }
  return true;
}

bool triangles_cross_at_shared_corner(const Corners& a, const Corners& b) {
  // What they share runs from the corner to the far edge of one of them.
  return triangles_touch({a[1], a[2], a[2]}, b) || triangles_touch(a, {b[1], b[2], b[2]});
}

}  // namespace particle_surface_tracker
