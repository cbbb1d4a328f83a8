#include "lattice_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>
#include <Eigen/Geometry>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {

namespace {

using Range = tbb::blocked_range<std::size_t>;

constexpr double kFarthestCell = 1 << 30;
constexpr double kMostCells = 0x1p31;
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// The lowest number in [0, count) for which is_bad(number) holds, or kNone.
template <typename IsBad>
std::size_t first_bad(std::size_t count, IsBad&& is_bad) {
  const auto search = [&](const Range& range, std::size_t found) {
    for (std::size_t n = range.begin(); n < range.end() && found == kNone; ++n) {
      if (is_bad(n)) found = n;
    }
    return found;
  };
  return tbb::parallel_reduce(Range(0, count, 4096), kNone, search,
                              [](std::size_t a, std::size_t b) { return std::min(a, b); });
}

/// Of the planes k with fl(k·h) ≤ x, the last one: a vertex on a plane is moved above it.
std::int32_t cell_along_axis(double x, double h) {
  auto k = static_cast<std::int32_t>(std::floor(x / h));
  while (static_cast<double>(k) * h > x) --k;
  while (static_cast<double>(k + 1) * h <= x) ++k;
  return k;
}

/// About how many cells a triangle passes through, within a small factor.
double estimated_cells(const Vec3d& p, const Vec3d& q, const Vec3d& r, double h) {
  const double area = 0.5 * (q - p).cross(r - p).cwiseAbs().sum();
  const double outline = ((q - p).cwiseAbs() + (r - p).cwiseAbs()).sum();
  return area / (h * h) + outline / h;
}

void check_positions(const LatticeMesh& mesh) {
  const double farthest = kFarthestCell * mesh.h;
  const std::size_t v = first_bad(mesh.positions->size(), [&](std::size_t n) {
    return !((*mesh.positions)[n].cast<double>().cwiseAbs().array() < farthest).all();
  });
  if (v == kNone) return;
  const Vec3f& p = (*mesh.positions)[v];
  throw MeshError(
      fmt::format("Vertex {} at ({}, {}, {}) m is not within 2^30 cells of {} m of the origin; check the positions, or "
                  "use larger cells (dx_gamma).",
                  v, p.x(), p.y(), p.z(), mesh.h));
}

void check_triangles(const LatticeMesh& mesh) {
  const std::size_t count = mesh.positions->size();
  const std::size_t t = first_bad(mesh.triangles->size(), [&](std::size_t n) {
    const Triangle& triangle = (*mesh.triangles)[n];
    return *std::max_element(triangle.begin(), triangle.end()) >= count;
  });
  if (t == kNone) return;
  const auto& [a, b, c] = (*mesh.triangles)[t];
  throw MeshError(fmt::format("Triangle {} names the vertices {}, {}, {}, but there are only {}.", t, a, b, c, count));
}

void check_size(const LatticeMesh& mesh) {
  const auto count_range = [&](const Range& range, double sum) {
    for (std::size_t n = range.begin(); n < range.end(); ++n) {
      const auto& [a, b, c] = (*mesh.triangles)[n];
      sum += estimated_cells(mesh.position(a).cast<double>(), mesh.position(b).cast<double>(),
                             mesh.position(c).cast<double>(), mesh.h);
    }
    return sum;
  };
  const double cells = tbb::parallel_deterministic_reduce(Range(0, mesh.triangles->size(), 4096), 0.0, count_range,
                                                          [](double a, double b) { return a + b; });
  if (cells < kMostCells) return;
  throw MeshError(
      fmt::format("The mesh passes through about {:.1e} cells of {} m, more than {:.1e}; use larger cells (dx_gamma).",
                  cells, mesh.h, kMostCells));
}

}  // namespace

LatticeMesh::LatticeMesh(const std::vector<Vec3f>& mesh_positions, const std::vector<Triangle>& mesh_triangles,
                         double cell_size)
    : positions(&mesh_positions), triangles(&mesh_triangles), h(cell_size) {
  if (!(h >= 1e-30 && h <= 1e30)) {
    throw ParameterError(fmt::format("The cell size of the lattice is {} m; it must be in [1e-30, 1e30] m.", h));
  }
  check_positions(*this);
  check_triangles(*this);
  check_size(*this);
  cells.resize(positions->size());
  tbb::parallel_for(Range(0, cells.size(), 4096), [&](const Range& range) {
    for (std::size_t v = range.begin(); v < range.end(); ++v) {
      const Vec3f& p = (*positions)[v];
      cells[v].reset(cell_along_axis(p.x(), h), cell_along_axis(p.y(), h), cell_along_axis(p.z(), h));
    }
  });
}

}  // namespace particle_surface_tracker
