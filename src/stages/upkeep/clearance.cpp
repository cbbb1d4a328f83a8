#include "clearance.h"

#include <algorithm>
#include <optional>

namespace particle_surface_tracker {

bool Clearance::stays_clear(const EditableSurface& surface, const PlannedPatch& patch,
                            const Surroundings& surroundings) {
  planned_.clear();
  for (const PatchTriangle& triangle : patch.triangles) {
    planned_.add(triangle.vertices, triangle.corners);
  }
  find_others(planned_.box, patch, surroundings);
  if (!crosses(surface, planned_.all)) return true;

  replaced_.clear();
  for (const std::uint32_t t : patch.replaced) {
    replaced_.add(surface.triangle(t), surface.corners(t));
  }
  find_others(replaced_.box, patch, surroundings);
  return crosses(surface, replaced_.all);
}

void Clearance::BoxedTriangles::clear() {
  all.clear();
  box.setEmpty();
}

/// The corners are stored as floats, so the box is exact.
void Clearance::BoxedTriangles::add(const Triangle& vertices, const Corners& corners) {
  Eigen::AlignedBox3f of_triangle;
  for (const Vec3d& corner : corners) of_triangle.extend(corner.cast<float>());
  all.emplace_back(vertices, corners, of_triangle);
  box.extend(of_triangle);
}

/// The entries whose box meets one; without those of what the patch replaces.
void Clearance::find_others(const Eigen::AlignedBox3f& box, const PlannedPatch& patch,
                            const Surroundings& surroundings) {
  others_.clear();
  surroundings.for_each_near(box, [&](const Surroundings::Entry& entry) {
    const auto& replaced = patch.replaced;
    if (std::find(replaced.begin(), replaced.end(), entry.triangle) == replaced.end()) others_.push_back(entry);
  });
}

bool Clearance::crosses(const EditableSurface& surface, const std::vector<BoxedTriangle>& triangles) const {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t j = i + 1; j < triangles.size(); ++j) {
      if (triangles_cross(triangles[i].triangle, triangles[j].triangle)) return true;
    }
  }
  for (const Surroundings::Entry& other : others_) {
    std::optional<PlacedTriangle> placed;
    for (const BoxedTriangle& triangle : triangles) {
      if (!triangle.query.meets(other.box)) continue;
      if (!placed) {
        if (!surface.is_alive(other.triangle)) break;
        placed = place_triangle(surface.triangle(other.triangle), surface.corners(other.triangle));
      }
      if (triangles_cross(triangle.triangle, *placed)) return true;
    }
  }
  return false;
}

}  // namespace particle_surface_tracker
