#pragma once

#include <cstdint>
#include <vector>

#include "editable_surface.h"
#include "patch.h"
#include "surroundings.h"
#include "tolerances.h"

namespace particle_surface_tracker {

// What must hold before an operation is done, one function each, after Brochu and Bridson 2009. None of them changes
// anything.

/// The ends of an edge have exactly two neighbours in common, the apexes of its triangles: its collapse keeps a
/// manifold.
/// \param neighbors memory for the search.
bool meets_link_condition(const EditableSurface& surface, std::uint32_t half_edge,
                          std::vector<std::uint32_t>& neighbors);

/// No two triangles of the patch have the same vertices: a tetrahedron cannot lose a vertex.
bool has_no_duplicate_triangle(const PlannedPatch& patch);

/// No triangle of the patch has two corners at the same stored position, or no area.
bool has_no_degenerate_triangle(const PlannedPatch& patch);

/// No edge of the patch would have to be split.
bool has_no_long_edge(const PlannedPatch& patch, const Tolerances& tolerances);

/// The surface moves along its normal by at most `limit` [m] on average over the patch: the change of volume over the
/// area. Whatever is smaller than the limit passes.
bool keeps_volume(const EditableSurface& surface, const PlannedPatch& patch, double limit);

/// No triangle turns its front away.
bool keeps_normals(const PlannedPatch& patch);

/// No triangle becomes a sliver, or none with less than half the smallest angle before.
bool keeps_angles(const EditableSurface& surface, const PlannedPatch& patch, const Tolerances& tolerances);

/// No edge in or around the patch becomes folded, or none worse than the worst one before.
bool keeps_folds(const EditableSurface& surface, const PlannedPatch& patch, double largest_fold);

/// A triangle near a patch.
struct NearTriangle {
  Triangle vertices;
  Corners corners;
  Eigen::AlignedBox3f box;
};

/// The patch does not cross itself or the triangles around it, unless what it replaces did so already.
/// \param others memory for the search.
bool stays_clear(const EditableSurface& surface, const PlannedPatch& patch, const Surroundings& surroundings,
                 std::vector<NearTriangle>& others);

}  // namespace particle_surface_tracker
