#pragma once

#include <cstddef>
#include <vector>

#include "particle_surface_tracker/core/types.h"
#include "surface_search.h"

namespace particle_surface_tracker {

/// Takes x* to the foot of the perpendicular where the search ended beside it.
///
/// In a crease, where two parts of the surface are about equally near, the gradient turns along the path, and the
/// search ends where x − x* is far from perpendicular to the surface. |x − x*| then depends on how φ's lattice happens
/// to lie, and a vertex put back by δ would be shaken out of the crease frame by frame (docs/projection.md).
/// \param found what `search` found for vertices [begin, end); a place is only replaced by a nearer one.
/// \param r particle spacing [m].
void slide_to_foot_points(const std::vector<Vec3f>& vertices, std::size_t begin, std::size_t end, double r,
                          SurfaceSearch& search, std::vector<SurfacePoint>& found);

}  // namespace particle_surface_tracker
