#include "lattice_predicates.h"

#include <algorithm>
#include <cmath>

#include "expansion.h"

namespace particle_surface_tracker {

namespace {

/// Bound of the rounding error of a 3 × 3 determinant of differences, relative to the sum of the absolute values of its
/// terms (Shewchuk 1997).
constexpr double kTriangleError = (7.0 + 56.0 * 0x1p-53) * 0x1p-53;

int sign_of(double value) {
  return (value > 0.0) - (value < 0.0);
}

int exact_side_of_edge(const Vec3f& p, const Vec3f& q, int a, int b, double plane_a, double plane_b) {
  const auto left = exact_difference(q[a], p[a]) * exact_difference(plane_b, p[b]);
  const auto right = exact_difference(q[b], p[b]) * exact_difference(plane_a, p[a]);
  return (left - right).sign();
}

/// Component of (q − p) × (r − p) along `axis`.
Expansion<16> exact_normal(const Corners& corners, int axis) {
  const Vec3f& p = *corners[0];
  const Vec3f& q = *corners[1];
  const Vec3f& r = *corners[2];
  const int a = (axis + 1) % 3;
  const int b = (axis + 2) % 3;
  return exact_difference(q[a], p[a]) * exact_difference(r[b], p[b]) -
         exact_difference(q[b], p[b]) * exact_difference(r[a], p[a]);
}

/// Height of a node over the plane of a triangle, times the length of its normal.
Expansion<192> exact_height(const Corners& corners, const Vec3d& node) {
  const auto term = [&](int axis) {
    return exact_normal(corners, axis) * exact_difference(node[axis], (*corners[0])[axis]);
  };
  return term(0) + term(1) + term(2);
}

/// A determinant and what its rounding error is measured by.
struct Estimate {
  double value;
  double magnitude;
};

Estimate estimate_height(const Corners& corners, const Vec3d& node) {
  const Vec3d p = corners[0]->cast<double>() - node;
  const Vec3d q = corners[1]->cast<double>() - node;
  const Vec3d r = corners[2]->cast<double>() - node;
  Estimate estimate = {0.0, 0.0};
  for (int axis = 0; axis < 3; ++axis) {
    const int a = axis == 2 ? 0 : axis + 1;
    const int b = 3 - axis - a;
    const double left = q[a] * r[b];
    const double right = q[b] * r[a];
    estimate.value -= p[axis] * (left - right);
    estimate.magnitude += std::abs(p[axis]) * (std::abs(left) + std::abs(right));
  }
  return estimate;
}

/// True of copies of one triangle, which nothing else needs to be computed for.
bool have_same_corners(const Corners& first, const Corners& second) {
  return std::all_of(first.begin(), first.end(), [&](const Vec3f* p) {
    return std::any_of(second.begin(), second.end(), [&](const Vec3f* q) { return *p == *q; });
  });
}

/// Where a line along `axis` through a node crosses a triangle's plane: up to a common factor, the height of the node
/// over the plane divided by the component of the normal.
int exact_compare(const CrossedTriangle& first, const CrossedTriangle& second, int axis, const Vec3d& node) {
  const auto first_height = exact_height(first.corners, node) * exact_normal(second.corners, axis);
  const auto second_height = exact_height(second.corners, node) * exact_normal(first.corners, axis);
  return (second_height - first_height).sign() * first.facing * second.facing;
}

}  // namespace

int doubtful_side_of_edge(const Vec3f& p, const Vec3f& q, int a, int b, double plane_a, double plane_b) {
  const bool is_zero = (q[a] == p[a] || plane_b == p[b]) && (q[b] == p[b] || plane_a == p[a]);
  if (!is_zero) {
    const int side = exact_side_of_edge(p, q, a, b, plane_a, plane_b);
    if (side != 0) return side;
  }
  // A motion of the mesh along a changes the determinant by the rise of the edge along b, one along b by minus that
  // along a.
  const int by_a = (q[b] > p[b]) - (q[b] < p[b]);
  const int by_b = (q[a] < p[a]) - (q[a] > p[a]);
  if (a < b) return by_a != 0 ? by_a : by_b;
  return by_b != 0 ? by_b : by_a;
}

int side_of_triangle(const Corners& corners, const Vec3d& node) {
  const Estimate height = estimate_height(corners, node);
  if (std::abs(height.value) > kTriangleError * height.magnitude) return sign_of(height.value);
  if (height.magnitude > 0.0) {
    const int side = exact_height(corners, node).sign();
    if (side != 0) return side;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int facing = exact_normal(corners, axis).sign();
    if (facing != 0) return -facing;
  }
  return 0;
}

int compare_along_line(const CrossedTriangle& first, const CrossedTriangle& second, int axis, const Vec3d& node) {
  if (have_same_corners(first.corners, second.corners)) return 0;
  const int order = exact_compare(first, second, axis, node);
  if (order != 0) return order;
  for (int moved = 0; moved < 3; ++moved) {
    if (moved == axis) continue;
    const auto first_slope = exact_normal(first.corners, moved) * exact_normal(second.corners, axis);
    const auto second_slope = exact_normal(second.corners, moved) * exact_normal(first.corners, axis);
    const int slope = (first_slope - second_slope).sign() * first.facing * second.facing;
    if (slope != 0) return slope;
  }
  return 0;
}

}  // namespace particle_surface_tracker
