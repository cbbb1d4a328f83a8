#include "triangle_cells.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace particle_surface_tracker {

namespace {

/// Touching by rounding error counts as meeting: a cell too many is harmless, one too few is not [cells].
constexpr double kSlack = 1e-9;

/// True if `axis` separates a triangle from the unit cube centred at the origin.
bool separates(const Vec3d& axis, const std::array<Vec3d, 3>& t) {
  const double radius = 0.5 * axis.cwiseAbs().sum() + kSlack;
  const double a = axis.dot(t[0]);
  const double b = axis.dot(t[1]);
  const double c = axis.dot(t[2]);
  return std::min({a, b, c}) > radius || std::max({a, b, c}) < -radius;
}

/// Separating axes of a triangle and a cube: the triangle's normal and the products of its edges with the cube's axes.
/// The cube's own axes are settled by the bounding box that the caller walks.
bool meets_unit_cube(const std::array<Vec3d, 3>& t) {
  const std::array<Vec3d, 3> edges = {t[1] - t[0], t[2] - t[1], t[0] - t[2]};
  if (separates(edges[0].cross(edges[1]), t)) return false;
  for (const Vec3d& edge : edges) {
    for (int axis = 0; axis < 3; ++axis) {
      if (separates(edge.cross(Vec3d::Unit(axis)), t)) return false;
    }
  }
  return true;
}

}  // namespace

void append_triangle_cells(const std::array<Vec3d, 3>& corners, double h, std::vector<openvdb::Coord>& cells) {
  const std::array<Vec3d, 3> scaled = {corners[0] / h, corners[1] / h, corners[2] / h};
  const Vec3d lower = scaled[0].cwiseMin(scaled[1]).cwiseMin(scaled[2]);
  const Vec3d upper = scaled[0].cwiseMax(scaled[1]).cwiseMax(scaled[2]);
  const Eigen::Vector3i first = (lower.array() - kSlack).floor().cast<int>();
  const Eigen::Vector3i last = (upper.array() + kSlack).floor().cast<int>();
  for (int i = first.x(); i <= last.x(); ++i) {
    for (int j = first.y(); j <= last.y(); ++j) {
      for (int k = first.z(); k <= last.z(); ++k) {
        const Vec3d center(i + 0.5, j + 0.5, k + 0.5);
        if (meets_unit_cube({scaled[0] - center, scaled[1] - center, scaled[2] - center})) cells.emplace_back(i, j, k);
      }
    }
  }
}

}  // namespace particle_surface_tracker
