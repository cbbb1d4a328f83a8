#include "stages/lattice/exact_lattice.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace particle_surface_tracker::test {

namespace {

using openvdb::Coord;
using Number = ExactLattice::Number;

Number power_of_two(int exponent) {
  boost::multiprecision::mpz_int whole = 1;
  whole <<= std::abs(exponent);
  return exponent >= 0 ? Number(whole) : Number(1) / Number(whole);
}

/// Inside a triangle of a plane, its sides not counted.
bool is_inside(const std::array<std::array<Number, 2>, 3>& corners, const Number& x, const Number& y) {
  int sum = 0;
  for (int n = 0; n < 3; ++n) {
    const auto& p = corners[n];
    const auto& q = corners[(n + 1) % 3];
    const Number side = (q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]);
    sum += side > 0 ? 1 : (side < 0 ? -1 : 0);
  }
  return sum == 3 || sum == -3;
}

}  // namespace

ExactLattice::ExactLattice(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles, double h)
    : triangles_(triangles), h_(h) {
  const std::array<Number, 3> motion = {power_of_two(-500), power_of_two(-1200), power_of_two(-2000)};
  for (const Vec3f& p : positions) {
    Point& point = points_.emplace_back();
    for (int axis = 0; axis < 3; ++axis) point[axis] = Number(static_cast<double>(p[axis])) + motion[axis];
  }
}

Number ExactLattice::plane(std::int32_t k) const {
  return Number(static_cast<double>(k) * h_);
}

std::int32_t ExactLattice::cell_along(const Number& x) const {
  auto k = static_cast<std::int32_t>(std::lround(static_cast<double>(x) / h_)) + 2;
  while (plane(k) > x) --k;
  return k;
}

Coord ExactLattice::cell(std::uint32_t vertex) const {
  const Point& p = points_[vertex];
  return Coord(cell_along(p[0]), cell_along(p[1]), cell_along(p[2]));
}

Number ExactLattice::normal(std::uint32_t triangle, int axis) const {
  const auto& [a, b, c] = triangles_[triangle];
  const int i = (axis + 1) % 3;
  const int j = (axis + 2) % 3;
  return (points_[b][i] - points_[a][i]) * (points_[c][j] - points_[a][j]) -
         (points_[b][j] - points_[a][j]) * (points_[c][i] - points_[a][i]);
}

std::vector<ExactLattice::Crossing> ExactLattice::crossings(std::uint32_t triangle) const {
  std::vector<Crossing> found;
  for (int axis = 0; axis < 3; ++axis) {
    const Number facing = normal(triangle, axis);
    if (facing == 0) continue;
    const int first = (axis + 1) % 3;
    const int second = (axis + 2) % 3;
    std::array<std::array<Number, 2>, 3> corners;
    for (int n = 0; n < 3; ++n) {
      const Point& p = points_[triangles_[triangle][n]];
      corners[n] = {p[first], p[second]};
    }
    Coord lower = cell(triangles_[triangle][0]);
    Coord upper = lower;
    for (const std::uint32_t v : triangles_[triangle]) {
      lower.minComponent(cell(v));
      upper.maxComponent(cell(v));
    }
    for (std::int32_t i = lower[first] + 1; i <= upper[first]; ++i) {
      for (std::int32_t j = lower[second] + 1; j <= upper[second]; ++j) {
        if (!is_inside(corners, plane(i), plane(j))) continue;
        const Point& p = points_[triangles_[triangle][0]];
        const Number place = p[axis] - (normal(triangle, first) * (plane(i) - p[first]) +
                                        normal(triangle, second) * (plane(j) - p[second])) /
                                           facing;
        Coord node;
        node[first] = i;
        node[second] = j;
        node[axis] = cell_along(place);
        found.push_back({axis, node, triangle, facing > 0 ? -1 : 1, place});
      }
    }
  }
  std::sort(found.begin(), found.end(),
            [](const Crossing& p, const Crossing& q) { return std::tie(p.axis, p.node) < std::tie(q.axis, q.node); });
  return found;
}

Number ExactLattice::share(std::uint32_t a, std::uint32_t b, int axis, std::int32_t k) const {
  return (plane(k) - points_[a][axis]) / (points_[b][axis] - points_[a][axis]);
}

std::vector<ExactLattice::Segment> ExactLattice::segments(std::uint32_t triangle) const {
  std::vector<Segment> found;
  for (int axis = 0; axis < 3; ++axis) {
    std::int32_t lowest = cell(triangles_[triangle][0])[axis];
    std::int32_t highest = lowest;
    for (const std::uint32_t v : triangles_[triangle]) {
      lowest = std::min(lowest, cell(v)[axis]);
      highest = std::max(highest, cell(v)[axis]);
    }
    for (std::int32_t k = lowest + 1; k <= highest; ++k) append_segments(triangle, axis, k, found);
  }
  std::sort(found.begin(), found.end());
  return found;
}

void ExactLattice::append_segments(std::uint32_t triangle, int axis, std::int32_t k,
                                   std::vector<Segment>& segments) const {
  struct Stop {
    Number share;
    PointName name;
  };
  const std::array<int, 2> axes = {(axis + 1) % 3, (axis + 2) % 3};
  std::array<Point, 2> ends;  // up, down
  std::array<PointName, 2> names;
  for (int n = 0; n < 3; ++n) {
    const std::uint32_t from = triangles_[triangle][n];
    const std::uint32_t to = triangles_[triangle][(n + 1) % 3];
    const bool is_above = points_[from][axis] > plane(k);
    if (is_above == (points_[to][axis] > plane(k))) continue;
    Point& end = ends[is_above ? 1 : 0];
    const Number way = share(from, to, axis, k);
    for (int i = 0; i < 3; ++i) end[i] = points_[from][i] + way * (points_[to][i] - points_[from][i]);
    Coord node;
    node[axis] = k;
    for (const int i : axes) node[i] = cell_along(end[i]);
    names[is_above ? 1 : 0] = {true, axis, node, std::min(from, to), std::max(from, to)};
  }
  std::vector<Stop> stops = {{0, names[0]}, {1, names[1]}};
  for (const int i : axes) {
    const int other = axes[0] + axes[1] - i;
    const std::int32_t from = cell_along(ends[0][i]);
    const std::int32_t to = cell_along(ends[1][i]);
    for (std::int32_t line = std::min(from, to) + 1; line <= std::max(from, to); ++line) {
      const Number way = (plane(line) - ends[0][i]) / (ends[1][i] - ends[0][i]);
      Coord node;
      node[axis] = k;
      node[i] = line;
      node[other] = cell_along(ends[0][other] + way * (ends[1][other] - ends[0][other]));
      stops.push_back({way, {false, other, node, triangle, 0}});
    }
  }
  std::sort(stops.begin(), stops.end(), [](const Stop& p, const Stop& q) { return p.share < q.share; });
  // The way from up to down must have the lower side on the left, seen from the front: (normal × way) along the axis is
  // negative.
  const Number turn = normal(triangle, axes[0]) * (ends[1][axes[1]] - ends[0][axes[1]]) -
                      normal(triangle, axes[1]) * (ends[1][axes[0]] - ends[0][axes[0]]);
  for (std::size_t n = 0; n + 1 < stops.size(); ++n) {
    const Number middle = (stops[n].share + stops[n + 1].share) / 2;
    Coord face;
    face[axis] = k;
    for (const int i : axes) face[i] = cell_along(ends[0][i] + middle * (ends[1][i] - ends[0][i]));
    if (turn > 0) {
      segments.push_back({axis, face, stops[n + 1].name, stops[n].name});
    } else {
      segments.push_back({axis, face, stops[n].name, stops[n + 1].name});
    }
  }
}

}  // namespace particle_surface_tracker::test
