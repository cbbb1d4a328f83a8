#include "clearance.h"

#include <algorithm>
#include <optional>

namespace particle_surface_tracker {

bool Clearance::stays_clear(const EditableSurface& surface, const PlannedPatch& patch,
                            const Surroundings& surroundings) {
  planned_.clear();
  for (const PatchTriangle& triangle : patch.triangles) {
    planned_.push_back(make_boxed(triangle.vertices, triangle.corners));
  }
  find_others(planned_, patch, surroundings);
  if (!crosses(surface, planned_)) return true;

  replaced_.clear();
  for (const std::uint32_t t : patch.replaced) {
    replaced_.push_back(make_boxed(surface.triangle(t), surface.corners(t)));
  }
  find_others(replaced_, patch, surroundings);
  return crosses(surface, replaced_);
}

/// The corners are stored as floats, so the box is exact.
Clearance::BoxedTriangle Clearance::make_boxed(const Triangle& vertices, const Corners& corners) {
  BoxedTriangle boxed{place_triangle(vertices, corners), {}};
  for (const Vec3d& corner : corners) boxed.box.extend(corner.cast<float>());
  return boxed;
}

/// The entries whose box meets that of all the triangles together; without those of what the patch replaces.
void Clearance::find_others(const std::vector<BoxedTriangle>& triangles, const PlannedPatch& patch,
                            const Surroundings& surroundings) {
  Eigen::AlignedBox3f box;
  for (const BoxedTriangle& triangle : triangles) box.extend(triangle.box);
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
      if (!triangle.box.intersects(other.box)) continue;
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
