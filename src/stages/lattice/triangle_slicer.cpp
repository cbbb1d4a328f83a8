#include "triangle_slicer.h"

#include <algorithm>
#include <cmath>

#include "last_true.h"
#include "lattice_predicates.h"
#include "line_crossing.h"

namespace particle_surface_tracker {

namespace {

using openvdb::Coord;

int next(int axis) {
  return axis == 2 ? 0 : axis + 1;
}

LatticePoint on_face(const Coord& node, int axis, std::uint32_t a, std::uint32_t b, std::int8_t step, double place) {
  return {LatticePoint::Kind::kOnLatticeFace, static_cast<std::uint8_t>(axis), step, node, a, b, place};
}

}  // namespace

const std::vector<LatticePoint>& TriangleSlicer::find_crossings(std::uint32_t triangle) {
  triangle_ = triangle;
  vertices_ = mesh_->triangle(triangle);
  crossings_.clear();
  for (int axis = 0; axis < 3; ++axis) slice(axis);
  for (int axis = 0; axis < 3; ++axis) cross_lines(axis);
  return crossings_;
}

void TriangleSlicer::cut(std::uint32_t triangle, TriangleCut& result) {
  result.points = find_crossings(triangle);
  result.segments.clear();
  for (int corner = 0; corner < 3; ++corner) result.cells[corner] = mesh_->cells[vertices_[corner]];
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t n = 0; n < slices_[axis].size(); ++n) {
      walk(axis, first_plane_[axis] + static_cast<std::int32_t>(n), result);
    }
  }
}

void TriangleSlicer::slice(int axis) {
  const auto [a, b, c] = vertices_;
  const std::array<std::int32_t, 3> cells = {mesh_->cells[a][axis], mesh_->cells[b][axis], mesh_->cells[c][axis]};
  const auto [lowest, highest] = std::minmax({cells[0], cells[1], cells[2]});
  first_plane_[axis] = lowest + 1;
  slices_[axis].clear();
  for (std::int32_t k = lowest + 1; k <= highest; ++k) {
    Slice& slice = slices_[axis].emplace_back();
    for (int side = 0; side < 3; ++side) {
      const int end = next(side);
      if ((cells[side] >= k) == (cells[end] >= k)) continue;
      SidePoint& point = cells[end] >= k ? slice.up : slice.down;
      point = side_point(vertices_[side], vertices_[end], axis, k);
    }
  }
}

TriangleSlicer::SidePoint TriangleSlicer::side_point(std::uint32_t from, std::uint32_t to, int axis,
                                                     std::int32_t k) const {
  SidePoint point;
  point.a = std::min(from, to);
  point.b = std::max(from, to);
  const Vec3f& a = mesh_->position(point.a);
  const Vec3f& b = mesh_->position(point.b);
  point.step = a[axis] < b[axis] ? 1 : -1;
  point.place = std::clamp((mesh_->plane(k) - a[axis]) / (static_cast<double>(b[axis]) - a[axis]), 0.0, 1.0);
  point.square[0] = square_along(point, axis, k, next(axis));
  point.square[1] = square_along(point, axis, k, next(next(axis)));
  return point;
}

/// The cell along another axis that holds the point where a mesh edge crosses a plane.
std::int32_t TriangleSlicer::square_along(const SidePoint& point, int axis, std::int32_t k, int along) const {
  const auto [lower, upper] = std::minmax({mesh_->cells[point.a][along], mesh_->cells[point.b][along]});
  if (lower == upper) return lower;
  const Vec3f& a = mesh_->position(point.a);
  const Vec3f& b = mesh_->position(point.b);
  const double position = a[along] + point.place * (static_cast<double>(b[along]) - a[along]);
  // Seen along an edge that rises, lines at which it is past the line are on the side of −1.
  return last_true(lower, upper, position / mesh_->h, [&](std::int32_t line) {
    return side_of_edge(a, b, axis, along, mesh_->plane(k), mesh_->plane(line)) * point.step < 0;
  });
}

/// Finds where the triangle crosses the lattice lines along an axis: those of each plane across the next axis that lie
/// between the slice's ends.
void TriangleSlicer::cross_lines(int axis) {
  const int across = next(axis);
  const int along = next(across);
  rows_[axis].clear();
  for (std::size_t n = 0; n < slices_[across].size(); ++n) {
    const Slice& slice = slices_[across][n];
    const std::int32_t from = slice.up.square[0];
    const std::int32_t to = slice.down.square[0];
    const std::int32_t first = std::min(from, to) + 1;
    rows_[axis].push_back({first, static_cast<std::uint32_t>(crossings_.size())});
    // With the lower side on the left, the way leads towards +along where the normal's component is positive.
    const int facing = to > from ? 1 : -1;
    Coord node;
    node[across] = first_plane_[across] + static_cast<std::int32_t>(n);
    for (std::int32_t line = first; line <= std::max(from, to); ++line) {
      node[along] = line;
      const LineCrossing found =
          find_on_line(*mesh_, triangle_, node, axis, facing, std::min(slice.up.square[1], slice.down.square[1]),
                       std::max(slice.up.square[1], slice.down.square[1]));
      node[axis] = found.edge;
      crossings_.push_back({LatticePoint::Kind::kOnLatticeEdge, static_cast<std::uint8_t>(axis),
                            static_cast<std::int8_t>(-facing), node, triangle_, 0, found.place});
    }
  }
}

std::uint32_t TriangleSlicer::crossing(int axis, std::int32_t plane, std::int32_t line) const {
  const Row& row = rows_[axis][static_cast<std::size_t>(plane - first_plane_[next(axis)])];
  return row.first_point + static_cast<std::uint32_t>(line - row.first_line);
}

/// Follows the slice from square to square. Each lattice line that it crosses is crossed on a known edge, which tells
/// how far the way goes along that line before.
void TriangleSlicer::walk(int axis, std::int32_t k, TriangleCut& result) const {
  const int first = next(axis);
  const int second = next(first);
  const Slice& slice = slices_[axis][static_cast<std::size_t>(k - first_plane_[axis])];
  Coord square;
  square[axis] = k;
  square[first] = slice.up.square[0];
  square[second] = slice.up.square[1];
  const auto append = [&](const SidePoint& point) {
    Coord node;
    node[axis] = k;
    node[first] = point.square[0];
    node[second] = point.square[1];
    result.points.push_back(on_face(node, axis, point.a, point.b, point.step, point.place));
    return static_cast<std::uint32_t>(result.points.size() - 1);
  };
  std::uint32_t last = append(slice.up);
  const auto go_to = [&](std::uint32_t point) {
    result.segments.push_back({{square, static_cast<std::uint8_t>(axis)}, last, point});
    last = point;
  };
  const int first_step = slice.down.square[0] > square[first] ? 1 : -1;
  const int second_step = slice.down.square[1] > square[second] ? 1 : -1;
  const auto go_along_second = [&](std::int32_t target) {
    while (square[second] != target) {
      go_to(crossing(first, second_step > 0 ? square[second] + 1 : square[second], k));
      square[second] += second_step;
    }
  };
  while (square[first] != slice.down.square[0]) {
    const std::uint32_t point = crossing(second, k, first_step > 0 ? square[first] + 1 : square[first]);
    go_along_second(crossings_[point].node[second]);
    go_to(point);
    square[first] += first_step;
  }
  go_along_second(slice.down.square[1]);
  go_to(append(slice.down));
}

}  // namespace particle_surface_tracker
