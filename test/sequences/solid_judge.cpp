#include "sequences/solid_judge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <Eigen/Geometry>

namespace particle_surface_tracker::test {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point2 = Kernel::Point_2;
using Point3 = Kernel::Point_3;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Kernel::Triangle_3>::const_iterator>;
using AabbTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Point2 seen_from_above(const Point3& p) {
  return Point2(p.x(), p.y());
}

/// Side of the line a → b on which q lies, +1 left and −1 right, with q moved by (ε, ε²) where it lies on the line, so
/// that a ray never hits an edge or a corner. 0 only where a = b.
int side_of_line(const Point2& a, const Point2& b, const Point2& q) {
  const CGAL::Orientation side = CGAL::orientation(a, b, q);
  if (side != CGAL::COLLINEAR) return side == CGAL::LEFT_TURN ? 1 : -1;
  if (a.y() != b.y()) return a.y() < b.y() ? -1 : 1;
  if (a.x() != b.x()) return a.x() < b.x() ? 1 : -1;
  return 0;
}

/// +1 where a ray upwards from q leaves through the front of the triangle, −1 where it enters through its back, else 0.
int crossing_above(const Kernel::Triangle_3& t, const Point3& q) {
  const Point2 a = seen_from_above(t[0]);
  const Point2 b = seen_from_above(t[1]);
  const Point2 c = seen_from_above(t[2]);
  const Point2 p = seen_from_above(q);
  const int side = side_of_line(a, b, p);
  if (side == 0 || side_of_line(b, c, p) != side || side_of_line(c, a, p) != side) return 0;
  // Of a triangle that faces up (side > 0), q is below when it is on the negative side of its plane.
  const CGAL::Orientation facing = CGAL::orientation(t[0], t[1], t[2], q);
  const bool is_above = side > 0 ? facing == CGAL::NEGATIVE : facing == CGAL::POSITIVE;
  return is_above ? side : 0;
}

}  // namespace

struct SolidJudge::Tree {
  std::vector<Kernel::Triangle_3> triangles;
  AabbTree tree;
};

/// The triangles sorted into square columns along z, so that a ray upwards meets few of them.
struct SolidJudge::Columns {
  Eigen::AlignedBox2d box;
  double width = 1.0;
  Eigen::Array2i count{1, 1};
  std::vector<std::size_t> begin;
  std::vector<std::uint32_t> triangles;

  Eigen::Array2i column_of(double x, double y) const {
    const Eigen::Array2d place = (Eigen::Array2d(x, y) - box.min().array()) / width;
    return place.floor().max(0.0).min(count.cast<double>() - 1.0).cast<int>();
  }

  std::size_t index_of(int i, int j) const {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(count.y()) + static_cast<std::size_t>(j);
  }

  template <typename Visit>
  void for_columns_of(const Kernel::Triangle_3& triangle, Visit&& visit) const {
    const CGAL::Bbox_3 bounds = triangle.bbox();
    const Eigen::Array2i first = column_of(bounds.xmin(), bounds.ymin());
    const Eigen::Array2i last = column_of(bounds.xmax(), bounds.ymax());
    for (int i = first.x(); i <= last.x(); ++i) {
      for (int j = first.y(); j <= last.y(); ++j) visit(index_of(i, j));
    }
  }

  explicit Columns(const std::vector<Kernel::Triangle_3>& all) {
    for (const Kernel::Triangle_3& t : all) {
      const CGAL::Bbox_3 bounds = t.bbox();
      box.extend(Eigen::Vector2d(bounds.xmin(), bounds.ymin()));
      box.extend(Eigen::Vector2d(bounds.xmax(), bounds.ymax()));
    }
    if (all.empty()) box.extend(Eigen::Vector2d(0.0, 0.0));
    const double area = std::max(box.sizes().prod(), 1e-12);
    width = std::sqrt(area / static_cast<double>(all.size() + 1));
    count = (box.sizes().array() / width).ceil().max(1.0).min(4096.0).cast<int>();
    width = (box.sizes().array() / count.cast<double>()).maxCoeff();
    if (width <= 0.0) width = 1.0;

    begin.assign(index_of(count.x(), 0) + 1, 0);
    for (const Kernel::Triangle_3& t : all) for_columns_of(t, [&](std::size_t column) { ++begin[column + 1]; });
    for (std::size_t column = 1; column < begin.size(); ++column) begin[column] += begin[column - 1];
    triangles.resize(begin.back());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (std::uint32_t t = 0; t < all.size(); ++t) {
      for_columns_of(all[t], [&](std::size_t column) { triangles[next[column]++] = t; });
    }
  }
};

SolidJudge::SolidJudge(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles)
    : tree_(std::make_unique<Tree>()) {
  const auto point = [&](std::uint32_t v) { return Point3(positions[v].x(), positions[v].y(), positions[v].z()); };
  for (const auto& [a, b, c] : triangles) tree_->triangles.emplace_back(point(a), point(b), point(c));
  tree_->tree.insert(tree_->triangles.begin(), tree_->triangles.end());
  tree_->tree.build();
  tree_->tree.accelerate_distance_queries();
  columns_ = std::make_unique<Columns>(tree_->triangles);
}

SolidJudge::SolidJudge(SolidJudge&&) noexcept = default;
SolidJudge::~SolidJudge() = default;

std::vector<SolidJudge::Crossing> SolidJudge::crossings_above(const Vec3d& point) const {
  const Point3 q(point.x(), point.y(), point.z());
  if (!columns_->box.contains(Eigen::Vector2d(q.x(), q.y()))) return {};
  const Eigen::Array2i place = columns_->column_of(q.x(), q.y());
  const std::size_t column = columns_->index_of(place.x(), place.y());
  std::vector<Crossing> crossings;
  for (std::size_t n = columns_->begin[column]; n < columns_->begin[column + 1]; ++n) {
    const std::uint32_t triangle = columns_->triangles[n];
    const int sign = crossing_above(tree_->triangles[triangle], q);
    if (sign != 0) crossings.push_back({triangle, sign});
  }
  return crossings;
}

int SolidJudge::winding_number(const Vec3d& point) const {
  int winding = 0;
  for (const Crossing& crossing : crossings_above(point)) winding += crossing.sign;
  return winding;
}

SolidJudge::Nearest SolidJudge::nearest(const Vec3f& point) const {
  const Point3 q(point.x(), point.y(), point.z());
  const auto [place, primitive] = tree_->tree.closest_point_and_primitive(q);
  return {std::sqrt(CGAL::squared_distance(q, place)),
          static_cast<std::uint32_t>(primitive - tree_->triangles.begin())};
}

double SolidJudge::distance(const Vec3d& point) const {
  return std::sqrt(tree_->tree.squared_distance(Point3(point.x(), point.y(), point.z())));
}

double SolidJudge::covered_share(const std::vector<Vec3f>& points, double tolerance) const {
  if (points.empty()) return 1.0;
  const auto count_range = [&](const tbb::blocked_range<std::size_t>& range, std::size_t covered) {
    for (std::size_t n = range.begin(); n < range.end(); ++n) {
      if (winding_number(points[n]) > 0 || distance(points[n].cast<double>()) <= tolerance) ++covered;
    }
    return covered;
  };
  const std::size_t covered = tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, points.size(), 256),
                                                   std::size_t{0}, count_range, std::plus<>());
  return static_cast<double>(covered) / static_cast<double>(points.size());
}

}  // namespace particle_surface_tracker::test
