#include "line_crossing.h"

#include <algorithm>
#include <array>

#include "last_true.h"
#include "lattice_predicates.h"

namespace particle_surface_tracker {

namespace {

/// Twice the area of the triangle between the edge p → q and a lattice line, seen along the line, with its sign.
double edge_area(const Vec3f& p, const Vec3f& q, int a, int b, double plane_a, double plane_b) {
  return (static_cast<double>(q[a]) - p[a]) * (plane_b - p[b]) - (static_cast<double>(q[b]) - p[b]) * (plane_a - p[a]);
}

/// Coordinate along the line of the place where a triangle crosses it, rounded: between those of the corners, however
/// thin the triangle is.
double rounded_position(const Corners& corners, int axis, double plane_a, double plane_b) {
  const int a = (axis + 1) % 3;
  const int b = (axis + 2) % 3;
  std::array<double, 3> weights;
  for (int n = 0; n < 3; ++n) {
    weights[n] = edge_area(*corners[(n + 1) % 3], *corners[(n + 2) % 3], a, b, plane_a, plane_b);
  }
  const auto corner = [&](int n) { return static_cast<double>((*corners[n])[axis]); };
  const double total = weights[0] + weights[1] + weights[2];
  const double rise = weights[1] * (corner(1) - corner(0)) + weights[2] * (corner(2) - corner(0));
  const auto [lowest, highest] = std::minmax({corner(0), corner(1), corner(2)});
  const double position = corner(0) + rise / total;
  if (position <= lowest) return lowest;
  return position < highest ? position : highest;
}

}  // namespace

LineCrossing find_on_line(const LatticeMesh& mesh, std::uint32_t triangle, const openvdb::Coord& line, int axis,
                          int facing, std::int32_t lowest, std::int32_t highest) {
  const auto& [p, q, r] = mesh.triangle(triangle);
  const Corners corners = {&mesh.position(p), &mesh.position(q), &mesh.position(r)};
  const double position =
      rounded_position(corners, axis, mesh.plane(line[(axis + 1) % 3]), mesh.plane(line[(axis + 2) % 3]));
  const std::int32_t edge = last_true(lowest, highest, position / mesh.h, [&](std::int32_t k) {
    openvdb::Coord node = line;
    node[axis] = k;
    return side_of_triangle(corners, mesh.node(node)) * facing < 0;
  });
  const double below = mesh.plane(edge);
  const double place = (position - below) / (mesh.plane(edge + 1) - below);
  return {edge, std::clamp(place, 0.0, 1.0)};
}

}  // namespace particle_surface_tracker
