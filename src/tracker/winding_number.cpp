#include "winding_number.h"

#include <array>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <Eigen/Geometry>

namespace particle_surface_tracker {

namespace {

/// Triangles by the columns along x that they cross, as one list of triangles per column.
class Columns {
 public:
  Columns(const TriangleMesh& mesh, double cell_size) : cell_(cell_size) {
    Eigen::AlignedBox3d box;
    for (const Vec3f& p : mesh.positions()) box.extend(p.cast<double>());
    lower_ = box.min();
    const Vec3d extent = box.sizes() / cell_;
    for (int axis = 0; axis < 2; ++axis) size_[axis] = static_cast<std::size_t>(extent[axis + 1]) + 1;
    std::vector<std::uint32_t> count(size_[0] * size_[1] + 1, 0);
    for_each_column(mesh, [&](std::size_t column, std::uint32_t) { ++count[column + 1]; });
    for (std::size_t c = 1; c < count.size(); ++c) count[c] += count[c - 1];
    begin_ = count;
    triangles_.resize(count.back());
    for_each_column(mesh, [&](std::size_t column, std::uint32_t triangle) { triangles_[count[column]++] = triangle; });
  }

  template <typename Visit>
  void for_each_triangle(const Vec3d& point, Visit&& visit) const {
    const double y = std::floor((point.y() - lower_.y()) / cell_);
    const double z = std::floor((point.z() - lower_.z()) / cell_);
    if (y < 0 || z < 0 || y >= static_cast<double>(size_[0]) || z >= static_cast<double>(size_[1])) return;
    const std::size_t column = static_cast<std::size_t>(y) * size_[1] + static_cast<std::size_t>(z);
    for (std::uint32_t n = begin_[column]; n < begin_[column + 1]; ++n) visit(triangles_[n]);
  }

 private:
  template <typename Visit>
  void for_each_column(const TriangleMesh& mesh, Visit&& visit) const {
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
      Eigen::AlignedBox3d box;
      for (const std::uint32_t v : mesh.triangles()[t]) box.extend(mesh.positions()[v].cast<double>());
      const Vec3d from = (box.min() - lower_) / cell_;
      const Vec3d to = (box.max() - lower_) / cell_;
      for (auto y = static_cast<std::size_t>(from.y()); y <= static_cast<std::size_t>(to.y()); ++y) {
        for (auto z = static_cast<std::size_t>(from.z()); z <= static_cast<std::size_t>(to.z()); ++z) {
          visit(y * size_[1] + z, t);
        }
      }
    }
  }

  double cell_;
  Vec3d lower_;
  std::array<std::size_t, 2> size_{};
  std::vector<std::uint32_t> begin_;
  std::vector<std::uint32_t> triangles_;
};

/// On which side of the edge a→b, seen along x, a point lies. Both triangles at an edge ask in the same order of its
/// ends, so that a point exactly on it is in one of them. Rays from a point of a grid pass through vertices and along
/// edges: so all are decided for a point that is moved by an infinitely small step along y, and by a much smaller one
/// along z.
bool is_left_of(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b, const Vec3d& p) {
  if (a > b) return !is_left_of(mesh, b, a, p);
  const Vec3d from = mesh.positions()[a].cast<double>();
  const Vec3d to = mesh.positions()[b].cast<double>();
  const double y = to.y() - from.y();
  const double z = to.z() - from.z();
  const double side = y * (p.z() - from.z()) - z * (p.y() - from.y());
  if (side != 0.0) return side > 0.0;
  return z != 0.0 ? z < 0.0 : y > 0.0;
}

/// +1 or −1 if the ray from p along x passes through the triangle out of or into the solid, else 0.
int crossing(const TriangleMesh& mesh, const Triangle& t, const Vec3d& p) {
  const bool left = is_left_of(mesh, t[0], t[1], p);
  if (is_left_of(mesh, t[1], t[2], p) != left || is_left_of(mesh, t[2], t[0], p) != left) return 0;
  const Vec3d a = mesh.positions()[t[0]].cast<double>();
  const Vec3d normal = (mesh.positions()[t[1]].cast<double>() - a).cross(mesh.positions()[t[2]].cast<double>() - a);
  if (normal.x() == 0.0) return 0;
  const double x = a.x() - ((p.y() - a.y()) * normal.y() + (p.z() - a.z()) * normal.z()) / normal.x();
  if (x < p.x()) return 0;
  return left ? 1 : -1;
}

}  // namespace

std::vector<int> winding_numbers(const TriangleMesh& mesh, const std::vector<Vec3f>& points, double cell_size) {
  const Columns columns(mesh, cell_size);
  std::vector<int> windings(points.size(), 0);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, points.size()), [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          const Vec3d p = points[i].cast<double>();
          columns.for_each_triangle(p, [&](std::uint32_t t) { windings[i] += crossing(mesh, mesh.triangles()[t], p); });
        }
      });
  return windings;
}

}  // namespace particle_surface_tracker
