#pragma once

#include <vector>

#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/stages/projection.h"
#include "stage_timer.h"

namespace particle_surface_tracker {

/// Projects vertices with as much of φ as they need (Sec. 5.1: φ is computed locally): first only the nodes that cubic
/// interpolation touches next to the isosurface and the vertices; then, for the vertices that this does not lead to the
/// isosurface, a band of theirs, and of twice the reach, and again, up to `max_reach`.
/// \param delta δ of each vertex [m].
/// \param reach first reach [m].
/// \param max_reach last reach [m].
Projection project_within_band(const std::vector<Vec3f>& vertices, const std::vector<float>& delta,
                               const ImplicitSurface& surface, double reach, double max_reach,
                               const Parameters& parameters, StageTimer& timer);

}  // namespace particle_surface_tracker
