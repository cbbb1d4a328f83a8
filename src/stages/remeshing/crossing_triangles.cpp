#include "crossing_triangles.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include <Eigen/Geometry>

#include "core/exact_triangles.h"

namespace particle_surface_tracker::remeshing {

namespace {

/// Largest relative error of a height over a plane, in double precision, with room to spare.
constexpr double kRounding = 1e-12;

/// A triangle of a cell, made ready for being compared with many.
struct Sheet {
  Triangle vertices;
  std::array<Vec3d, 3> corners;
  Vec3d normal;
  Vec3d lower;
  Vec3d upper;

  Sheet(const MeshLattice& lattice, std::uint32_t triangle) : vertices(lattice.triangles()[triangle]) {
    for (int k = 0; k < 3; ++k) corners[k] = lattice.positions()[vertices[k]].cast<double>();
    normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    lower = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
    upper = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
  }

  int shared_with(const Sheet& other) const {
    int shared = 0;
    for (const std::uint32_t v : vertices) shared += has(other, v) ? 1 : 0;
    return shared;
  }

  /// Whether all corners that the two do not share are on one side of the other's plane, beyond rounding.
  bool lies_beside(const Sheet& other) const {
    bool above = true, below = true;
    for (int k = 0; k < 3; ++k) {
      if (has(other, vertices[k])) continue;
      const Vec3d offset = corners[k] - other.corners[0];
      const double height = other.normal.dot(offset);
      const double rounding = kRounding * other.normal.norm() * offset.norm();
      above = above && height > rounding;
      below = below && height < -rounding;
    }
    return above || below;
  }

 private:
  static bool has(const Sheet& sheet, std::uint32_t vertex) {
    return std::find(sheet.vertices.begin(), sheet.vertices.end(), vertex) != sheet.vertices.end();
  }
};

class CellSearch {
 public:
  explicit CellSearch(const MeshLattice& lattice) : lattice_(lattice) {}

  bool has_crossing(const openvdb::Coord& cell) {
    sheets_.clear();
    for (const std::uint32_t t : lattice_.triangles_in_cell(cell)) sheets_.emplace_back(lattice_, t);
    for (int axis = 0; axis < 3; ++axis) {
      lower_[axis] = lattice_.plane(cell[axis]);
      upper_[axis] = lattice_.plane(cell[axis] + 1);
    }
    for (std::size_t a = 0; a < sheets_.size(); ++a) {
      for (std::size_t b = a + 1; b < sheets_.size(); ++b) {
        if (cross(sheets_[a], sheets_[b])) return true;
      }
    }
    return false;
  }

 private:
  bool cross(const Sheet& a, const Sheet& b) const {
    const Vec3d lower = a.lower.cwiseMax(b.lower).cwiseMax(lower_);
    const Vec3d upper = a.upper.cwiseMin(b.upper).cwiseMin(upper_);
    if ((lower.array() > upper.array()).any() || a.shared_with(b) > 1) return false;
    if (a.lies_beside(b) || b.lies_beside(a)) return false;
    if (is_flat(lattice_.positions(), a.vertices) || is_flat(lattice_.positions(), b.vertices)) return false;
    return meet_beyond_shared(lattice_.positions(), a.vertices, b.vertices);
  }

  const MeshLattice& lattice_;
  std::vector<Sheet> sheets_;
  Vec3d lower_;
  Vec3d upper_;
};

}  // namespace

std::vector<openvdb::Coord> find_crossing_cells(const MeshLattice& lattice) {
  const std::vector<openvdb::Coord> cells = lattice.cells();
  std::vector<char> crossed(cells.size(), 0);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size(), 256), [&](const auto& range) {
    CellSearch search(lattice);
    for (std::size_t n = range.begin(); n < range.end(); ++n) crossed[n] = search.has_crossing(cells[n]) ? 1 : 0;
  });
  std::vector<openvdb::Coord> found;
  for (std::size_t n = 0; n < cells.size(); ++n) {
    if (crossed[n] != 0) found.push_back(cells[n]);
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace particle_surface_tracker::remeshing
