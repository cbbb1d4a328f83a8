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
  replaced_.clear();
  for (const std::uint32_t t : patch.replaced) {
    replaced_.push_back(make_boxed(surface.triangle(t), surface.corners(t)));
  }
  find_others(patch, surroundings);
  return !crosses(surface, planned_) || crosses(surface, replaced_);
}

/// The corners are stored as floats, so the box is exact.
Clearance::BoxedTriangle Clearance::make_boxed(const Triangle& vertices, const Corners& corners) {
  BoxedTriangle boxed{place_triangle(vertices, corners), {}};
  for (const Vec3d& corner : corners) boxed.box.extend(corner.cast<float>());
  return boxed;
}

/// The triangles whose box meets that of the patch or of what it replaces; without the latter.
void Clearance::find_others(const PlannedPatch& patch, const Surroundings& surroundings) {
  Eigen::AlignedBox3f box;
  for (const BoxedTriangle& planned : planned_) box.extend(planned.box);
  for (const BoxedTriangle& replaced : replaced_) box.extend(replaced.box);
  others_.clear();
  surroundings.for_each_near(box, [&](std::uint32_t t) {
    if (std::find(patch.replaced.begin(), patch.replaced.end(), t) == patch.replaced.end()) others_.push_back(t);
  });
}

bool Clearance::crosses(const EditableSurface& surface, const std::vector<BoxedTriangle>& triangles) const {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (std::size_t j = i + 1; j < triangles.size(); ++j) {
      if (triangles_cross(triangles[i].triangle, triangles[j].triangle)) return true;
    }
  }
  for (const std::uint32_t other : others_) {
    const Triangle& vertices = surface.triangle(other);
    Eigen::AlignedBox3f box;
    for (const std::uint32_t vertex : vertices) box.extend(surface.stored_position(vertex));
    std::optional<PlacedTriangle> placed;
    for (const BoxedTriangle& triangle : triangles) {
      if (!triangle.box.intersects(box)) continue;
      if (!placed) placed = place_triangle(vertices, surface.corners(other));
      if (triangles_cross(triangle.triangle, *placed)) return true;
    }
  }
  return false;
}

}  // namespace particle_surface_tracker
