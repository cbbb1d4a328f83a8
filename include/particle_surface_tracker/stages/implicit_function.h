#pragma once

#include <openvdb/openvdb.h>

#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/particle_grid.h"

namespace particle_surface_tracker {

/// The cell size that evaluate_implicit_function() wants its particle grid to have [m]: the largest multiple of Δx_φ
/// that is not above r (or Δx_φ itself, if that is larger).
double implicit_function_cell_size(const Parameters& parameters);

/// φ̃ at the nodes of every cell that its zero level passes through (Sec. 5.1; Solenthaler et al. 2007, with the reading
/// of the attenuation that docs/implicit_surface.md explains).
///
/// Time follows the surface: nodes well inside and well outside are never looked at. The result depends on the
/// positions and their order in the grid only, not on the number of threads or the processor.
/// \param particles cell size as implicit_function_cell_size() says.
/// \return dx and field; the triangulation is empty.
ImplicitSurface evaluate_implicit_function(const ParticleGrid& particles, const Parameters& parameters);

/// φ̃ at one position from all particles within reach, in double precision [m]: the definition, for tests and probes.
double implicit_function_at(const ParticleGrid& particles, const Vec3d& position, const Parameters& parameters);

}  // namespace particle_surface_tracker
