#include "crossing_finder.h"

#include "lattice_predicates.h"
#include "line_crossing.h"

namespace particle_surface_tracker {

namespace {

using openvdb::Coord;

/// Lines along one axis that are tested one by one; beyond, following the triangle's cuts is faster.
constexpr std::int64_t kFewLines = 6;

}  // namespace

void CrossingFinder::append_crossings(std::uint32_t triangle, std::vector<EdgeCrossing>& crossings) {
  const auto& [a, b, c] = mesh_.triangle(triangle);
  const Box box = {Coord::minComponent(Coord::minComponent(mesh_.cells[a], mesh_.cells[b]), mesh_.cells[c]),
                   Coord::maxComponent(Coord::maxComponent(mesh_.cells[a], mesh_.cells[b]), mesh_.cells[c])};
  const std::int64_t nx = box.planes(0);
  const std::int64_t ny = box.planes(1);
  const std::int64_t nz = box.planes(2);
  if (nx * ny <= kFewLines && ny * nz <= kFewLines && nz * nx <= kFewLines) {
    for (int axis = 0; axis < 3; ++axis) test_lines(triangle, box, axis, crossings);
    return;
  }
  for (const LatticePoint& point : slicer_.find_crossings(triangle)) {
    crossings.push_back({{point.node, point.axis}, triangle, point.step, point.place});
  }
}

void CrossingFinder::test_lines(std::uint32_t triangle, const Box& box, int axis,
                                std::vector<EdgeCrossing>& crossings) const {
  const int first = axis == 2 ? 0 : axis + 1;
  const int second = 3 - axis - first;
  const auto& [a, b, c] = mesh_.triangle(triangle);
  const Vec3f& p = mesh_.position(a);
  const Vec3f& q = mesh_.position(b);
  const Vec3f& r = mesh_.position(c);
  Coord node;
  for (node[first] = box.lower[first] + 1; node[first] <= box.upper[first]; ++node[first]) {
    const double plane_first = mesh_.plane(node[first]);
    for (node[second] = box.lower[second] + 1; node[second] <= box.upper[second]; ++node[second]) {
      const double plane_second = mesh_.plane(node[second]);
      const int facing = side_of_edge(p, q, first, second, plane_first, plane_second);
      if (facing == 0 || side_of_edge(q, r, first, second, plane_first, plane_second) != facing ||
          side_of_edge(r, p, first, second, plane_first, plane_second) != facing) {
        continue;
      }
      const LineCrossing found = find_on_line(mesh_, triangle, node, axis, facing, box.lower[axis], box.upper[axis]);
      Coord lower_end = node;
      lower_end[axis] = found.edge;
      crossings.push_back(
          {{lower_end, static_cast<std::uint8_t>(axis)}, triangle, static_cast<std::int8_t>(-facing), found.place});
    }
  }
}

}  // namespace particle_surface_tracker
