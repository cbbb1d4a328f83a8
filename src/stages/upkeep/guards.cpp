#include "guards.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace particle_surface_tracker {

namespace {

/// A collapse may leave a sliver behind whose angle is this part of the worst one before: two triangles go, and the
/// next collapse may take it away. Held to 1, half of all short edges stay, and their neighbours with them.
constexpr double kAngleLoss = 0.5;

double six_volumes(const Corners& corners, const Vec3d& origin) {
  return (corners[0] - origin).dot((corners[1] - origin).cross(corners[2] - origin));
}

double smallest_replaced_sine(const EditableSurface& surface, const PlannedPatch& patch) {
  double smallest = 1.0;
  for (const std::uint32_t t : patch.replaced) {
    smallest = std::min(smallest, sine_of_smallest_angle(surface.corners(t)));
  }
  return smallest;
}

/// The largest fold in or around what is replaced, if it is beyond a limit, else that limit.
double largest_replaced_fold(const EditableSurface& surface, const PlannedPatch& patch, double limit) {
  double largest = limit;
  for (const std::uint32_t t : patch.replaced) {
    const Vec3d normal = area_normal(surface.corners(t));
    for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
      largest = std::max(largest, fold_between(normal, area_normal(surface.corners(surface.twin(h) / 3))));
    }
  }
  return largest;
}

/// The normals beyond the edges of a patch's triangles: of other triangles of the patch, or of those around it.
class NormalsBeyond {
 public:
  NormalsBeyond(const EditableSurface& surface, const PlannedPatch& patch) : surface_(surface), patch_(patch) {
    if (patch.triangles.size() <= kFewTriangles) return;
    for (std::uint32_t n = 0; n < patch.triangles.size(); ++n) {
      const Triangle& t = patch.triangles[n].vertices;
      for (std::size_t k = 0; k < 3; ++k) edges_.push_back({t[k], t[(k + 1) % 3], n});
    }
    std::sort(edges_.begin(), edges_.end());
  }

  /// Beyond edge k of a triangle of the patch.
  Vec3d at(const PatchTriangle& triangle, std::size_t k) const {
    const PatchTriangle* const other = find(triangle.vertices[(k + 1) % 3], triangle.vertices[k]);
    return area_normal(other != nullptr ? other->corners : surface_.corners(triangle.beyond[k] / 3));
  }

 private:
  /// Of more triangles the edges are sorted: a fan that fills a large cell can have thousands.
  static constexpr std::size_t kFewTriangles = 24;

  /// The first triangle with an edge from one vertex to another; null if there is none.
  const PatchTriangle* find(std::uint32_t from, std::uint32_t to) const {
    if (edges_.empty()) {
      for (const PatchTriangle& triangle : patch_.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
          if (triangle.vertices[k] == from && triangle.vertices[(k + 1) % 3] == to) return &triangle;
        }
      }
      return nullptr;
    }
    const auto found = std::lower_bound(edges_.begin(), edges_.end(), std::array<std::uint32_t, 3>{from, to, 0});
    if (found == edges_.end() || (*found)[0] != from || (*found)[1] != to) return nullptr;
    return &patch_.triangles[(*found)[2]];
  }

  const EditableSurface& surface_;
  const PlannedPatch& patch_;
  std::vector<std::array<std::uint32_t, 3>> edges_;  // from, to, triangle of the patch
};

}  // namespace

bool meets_link_condition(const EditableSurface& surface, std::uint32_t half_edge,
                          std::vector<std::uint32_t>& neighbors) {
  neighbors.clear();
  surface.for_each_outgoing(surface.start(half_edge), [&](std::uint32_t h) { neighbors.push_back(surface.end(h)); });
  std::sort(neighbors.begin(), neighbors.end());
  int common = 0;
  surface.for_each_outgoing(surface.end(half_edge), [&](std::uint32_t h) {
    if (std::binary_search(neighbors.begin(), neighbors.end(), surface.end(h))) ++common;
  });
  return common == 2;
}

bool has_no_duplicate_triangle(const PlannedPatch& patch) {
  // A fan that fills a large cell can have thousands of triangles around one vertex.
  std::vector<Triangle> sorted;
  sorted.reserve(patch.triangles.size());
  for (const PatchTriangle& triangle : patch.triangles) {
    sorted.push_back(triangle.vertices);
    std::sort(sorted.back().begin(), sorted.back().end());
  }
  std::sort(sorted.begin(), sorted.end());
  return std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
}

bool has_no_degenerate_triangle(const PlannedPatch& patch) {
  return std::all_of(patch.triangles.begin(), patch.triangles.end(), [](const PatchTriangle& triangle) {
    const Corners& c = triangle.corners;
    return c[0] != c[1] && c[1] != c[2] && c[2] != c[0] && area_normal(c).squaredNorm() > 0.0;
  });
}

bool has_no_long_edge(const PlannedPatch& patch, const Tolerances& tolerances) {
  for (const PatchTriangle& triangle : patch.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t next = (k + 1) % 3;
      const double limit = tolerances.longest_edge(triangle.vertices[k], triangle.vertices[next]);
      if ((triangle.corners[next] - triangle.corners[k]).squaredNorm() > limit * limit) return false;
    }
  }
  return true;
}

bool keeps_volume(const EditableSurface& surface, const PlannedPatch& patch, double limit) {
  const Vec3d origin = surface.corners(patch.replaced.front())[0];
  double change = 0.0, double_area = 0.0;
  for (const PatchTriangle& triangle : patch.triangles) change += six_volumes(triangle.corners, origin);
  for (const std::uint32_t t : patch.replaced) {
    const Corners corners = surface.corners(t);
    change -= six_volumes(corners, origin);
    double_area += area_normal(corners).norm();
  }
  return std::abs(change) / 6.0 <= limit * double_area / 2.0;
}

bool keeps_normals(const PlannedPatch& patch) {
  return std::all_of(patch.triangles.begin(), patch.triangles.end(), [](const PatchTriangle& triangle) {
    return triangle.old_normal.squaredNorm() == 0.0 || area_normal(triangle.corners).dot(triangle.old_normal) > 0.0;
  });
}

bool keeps_angles(const EditableSurface& surface, const PlannedPatch& patch, const Tolerances& tolerances) {
  double worst = 1.0;
  for (const PatchTriangle& triangle : patch.triangles) {
    const double sine = sine_of_smallest_angle(triangle.corners);
    if (sine < worst && tolerances.is_sliver(triangle.vertices, sine)) worst = sine;
  }
  return worst == 1.0 || worst >= kAngleLoss * smallest_replaced_sine(surface, patch);
}

bool keeps_folds(const EditableSurface& surface, const PlannedPatch& patch, double largest_fold) {
  double largest = 0.0;
  const NormalsBeyond normals(surface, patch);
  for (const PatchTriangle& triangle : patch.triangles) {
    const Vec3d normal = area_normal(triangle.corners);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3d beyond = normals.at(triangle, k);
      if (normal.dot(beyond) < 0.0) largest = std::max(largest, fold_between(normal, beyond));
    }
  }
  return largest <= largest_fold || largest <= largest_replaced_fold(surface, patch, largest_fold);
}

}  // namespace particle_surface_tracker
