#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include "particle_surface_tracker/stages/mesh_lattice.h"

#include "triangle_distance.h"

namespace particle_surface_tracker {

namespace {

using openvdb::Coord;

/// Looks for the closest triangle in the cells around a node, shell by shell.
class NodeDistance {
 public:
  NodeDistance(const MeshLattice& lattice, double reach)
      : lattice_(lattice),
        positions_(lattice.positions()),
        triangles_(lattice.triangles()),
        reach_squared_(reach * reach),
        asked_at_(triangles_.size(), 0) {}

  double find(const Coord& node) {
    ++number_;
    const double h = lattice_.h();
    const Vec3d place(lattice_.plane(node.x()), lattice_.plane(node.y()), lattice_.plane(node.z()));
    double closest = reach_squared_;
    // Triangles of shell s that are in no shell before are at least s cells away. A node's rounded place may be off by
    // a part in 2⁵³, which the margin covers.
    for (std::int32_t shell = 0; 0.999 * shell * h * shell * h < closest; ++shell) {
      for_cells_of(shell, [&](const Coord& offset) {
        if (0.999 * squared_gap(offset) * h * h >= closest) return;
        for (const std::uint32_t t : lattice_.triangles_in_cell(node + offset)) {
          // A triangle is in several cells.
          if (std::exchange(asked_at_[t], number_) == number_) continue;
          const std::array<Vec3d, 3> corners = corners_from(t, place);
          if (squared_distance_to_box(corners) >= closest) continue;
          closest = std::min(closest, squared_distance_to_triangle(corners));
        }
      });
    }
    return std::sqrt(closest);
  }

 private:
  /// Calls visit(offset) for the cells that are `shell` cells away from a node along one axis at least, and no more
  /// along any.
  template <typename Visit>
  static void for_cells_of(std::int32_t shell, Visit&& visit) {
    for (std::int32_t i = -1 - shell; i <= shell; ++i) {
      for (std::int32_t j = -1 - shell; j <= shell; ++j) {
        const bool is_outermost = i == -1 - shell || i == shell || j == -1 - shell || j == shell;
        const std::int32_t stride = is_outermost ? 1 : 2 * shell + 1;
        for (std::int32_t k = -1 - shell; k <= shell; k += stride) visit(Coord(i, j, k));
      }
    }
  }

  /// Squared distance of a node to the cell at an offset [cells²].
  static double squared_gap(const Coord& offset) {
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double gap = offset[axis] >= 0 ? offset[axis] : -1 - offset[axis];
      sum += gap * gap;
    }
    return sum;
  }

  std::array<Vec3d, 3> corners_from(std::uint32_t triangle, const Vec3d& place) const {
    const auto& [a, b, c] = triangles_[triangle];
    return {positions_[a].cast<double>() - place, positions_[b].cast<double>() - place,
            positions_[c].cast<double>() - place};
  }

  const MeshLattice& lattice_;
  const std::vector<Vec3f>& positions_;
  const std::vector<Triangle>& triangles_;
  double reach_squared_;
  std::uint32_t number_ = 0;             ///< Of the node that is asked about, from 1 on.
  std::vector<std::uint32_t> asked_at_;  ///< Of each triangle the last node that it was measured from.
};

}  // namespace

std::vector<float> signed_distances(const MeshLattice& lattice, const std::vector<Coord>& nodes, double reach) {
  std::vector<float> distances(nodes.size());
  tbb::enumerable_thread_specific<NodeDistance> searches([&] { return NodeDistance(lattice, reach); });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, nodes.size(), 64), [&](const auto& range) {
    NodeDistance& distance = searches.local();
    for (std::size_t n = range.begin(); n < range.end(); ++n) {
      const auto found = static_cast<float>(distance.find(nodes[n]));
      const bool is_inside = lattice.winding_number(nodes[n]) >= 1;
      distances[n] = is_inside ? -std::max(found, std::numeric_limits<float>::min()) : found;
    }
  });
  return distances;
}

}  // namespace particle_surface_tracker
