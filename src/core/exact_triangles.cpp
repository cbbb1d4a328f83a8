#include "exact_triangles.h"

#include <algorithm>
#include <array>

// clang-tidy's analyser misreads how this number type gives memory back.
#ifdef __clang_analyzer__
#define CGAL_DO_NOT_USE_MPZF
#endif
// Only CGAL's kernel, which is under the LGPL.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

namespace particle_surface_tracker {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = Kernel::Point_2;
using Point3 = Kernel::Point_3;
using Corners = std::array<Point3, 3>;

Point3 to_point(const Vec3f& p) {
  return Point3(p.x(), p.y(), p.z());
}

Corners corners_of(const std::vector<Vec3f>& positions, const Triangle& t) {
  return {to_point(positions[t[0]]), to_point(positions[t[1]]), to_point(positions[t[2]])};
}

Kernel::Triangle_3 to_triangle(const Corners& c) {
  return Kernel::Triangle_3(c[0], c[1], c[2]);
}

/// Whether points lie strictly on one side of the plane of a triangle, all of them.
template <std::size_t Count>
bool are_apart(const Corners& triangle, const std::array<Point3, Count>& points) {
  const CGAL::Orientation side = CGAL::orientation(triangle[0], triangle[1], triangle[2], points[0]);
  if (side == CGAL::COPLANAR) return false;
  return std::all_of(points.begin() + 1, points.end(), [&](const Point3& point) {
    return CGAL::orientation(triangle[0], triangle[1], triangle[2], point) == side;
  });
}

bool meet_without_shared(const Corners& a, const Corners& b) {
  return !are_apart(a, b) && !are_apart(b, a) && CGAL::do_intersect(to_triangle(a), to_triangle(b));
}

/// The triangles share their first corner. What they have in common is a point or a piece of a line that begins there,
/// or an area; beyond the corner, it reaches the opposite side of one of them.
bool meet_beyond_corner(const Corners& a, const Corners& b) {
  if (are_apart(a, std::array{b[1], b[2]}) || are_apart(b, std::array{a[1], a[2]})) return false;
  return CGAL::do_intersect(Kernel::Segment_3(a[1], a[2]), to_triangle(b)) ||
         CGAL::do_intersect(Kernel::Segment_3(b[1], b[2]), to_triangle(a));
}

/// The triangles share their first two corners: they meet beyond that edge only where one lies folded on the other.
bool meet_beyond_edge(const Corners& a, const Corners& b) {
  return CGAL::orientation(a[0], a[1], a[2], b[2]) == CGAL::COPLANAR &&
         CGAL::coplanar_orientation(a[0], a[1], a[2], b[2]) == CGAL::POSITIVE;
}

/// Puts shared vertices first, in the same order in both triangles; neither keeps its sense.
/// \return how many there are.
std::size_t bring_shared_forward(Triangle& a, Triangle& b) {
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto found = std::find(b.begin() + shared, b.end(), a[i]);
    if (found == b.end()) continue;
    std::swap(*found, b[shared]);
    std::swap(a[i], a[shared]);
    ++shared;
  }
  return shared;
}

Point2 seen_from_above(const Point3& p) {
  return Point2(p.x(), p.y());
}

/// What the edge from → to adds to the winding number of its triangle's shadow around p: whether it crosses the ray
/// from p along +x, upwards (+1) or downwards (−1). It owns its lower end, so that both its triangles see the same.
int shadow_crossing(const Point2& from, const Point2& to, const Point2& p) {
  const bool rises = from.y() <= p.y() && to.y() > p.y();
  const bool falls = to.y() <= p.y() && from.y() > p.y();
  if (!rises && !falls) return 0;
  const CGAL::Orientation side = CGAL::orientation(from, to, p);
  if (rises) return side == CGAL::LEFT_TURN ? 1 : 0;
  return side == CGAL::RIGHT_TURN ? -1 : 0;
}

}  // namespace

bool is_flat(const std::vector<Vec3f>& positions, const Triangle& triangle) {
  const Corners c = corners_of(positions, triangle);
  return CGAL::collinear(c[0], c[1], c[2]);
}

bool meet_beyond_shared(const std::vector<Vec3f>& positions, const Triangle& first, const Triangle& second) {
  Triangle a = first;
  Triangle b = second;
  const std::size_t shared = bring_shared_forward(a, b);
  if (shared == 3) return true;
  const Corners a_corners = corners_of(positions, a);
  const Corners b_corners = corners_of(positions, b);
  if (shared == 2) return meet_beyond_edge(a_corners, b_corners);
  if (shared == 1) return meet_beyond_corner(a_corners, b_corners);
  return meet_without_shared(a_corners, b_corners);
}

int crossing_above(const std::vector<Vec3f>& positions, const Triangle& triangle, const Vec3f& point) {
  const Corners corners = corners_of(positions, triangle);
  const Point2 a = seen_from_above(corners[0]);
  const Point2 b = seen_from_above(corners[1]);
  const Point2 c = seen_from_above(corners[2]);
  const Point3 q = to_point(point);
  const Point2 p = seen_from_above(q);
  const int shadow = shadow_crossing(a, b, p) + shadow_crossing(b, c, p) + shadow_crossing(c, a, p);
  if (shadow == 0) return 0;
  // Of a triangle that faces up, q is below when it is on the negative side of its plane.
  const CGAL::Orientation side = CGAL::orientation(corners[0], corners[1], corners[2], q);
  return side == (shadow > 0 ? CGAL::NEGATIVE : CGAL::POSITIVE) ? shadow : 0;
}

}  // namespace particle_surface_tracker
