#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "editable_surface.h"

namespace particle_surface_tracker {

/// Number of a vertex that an operation would make.
constexpr std::uint32_t kNewVertex = 0xfffffffeU;

/// One triangle that an operation would leave behind.
struct PatchTriangle {
  Triangle vertices;
  Corners corners;
  Vec3d old_normal;  ///< area_normal() of the triangle whose place it takes.
  /// The half-edge beyond each edge (corner k to k + 1), kNoHalfEdge where that is another triangle of the patch.
  std::array<std::uint32_t, 3> beyond;
};

/// What an operation would change, to be judged before it is done.
struct PlannedPatch {
  std::vector<PatchTriangle> triangles;  ///< What would be there.
  std::vector<std::uint32_t> replaced;   ///< Triangles that would go.
};

/// A collapse of the edge of `half_edge` onto its end, which would move to `position`.
void plan_collapse(const EditableSurface& surface, std::uint32_t half_edge, const Vec3f& position, PlannedPatch& patch);

/// A split of the edge of `half_edge` by a vertex at `position`.
void plan_split(const EditableSurface& surface, std::uint32_t half_edge, const Vec3f& position, PlannedPatch& patch);

/// A flip of the edge of `half_edge`.
void plan_flip(const EditableSurface& surface, std::uint32_t half_edge, PlannedPatch& patch);

}  // namespace particle_surface_tracker
