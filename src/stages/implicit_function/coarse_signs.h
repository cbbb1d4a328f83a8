#pragma once

#include "node_lattice.h"
#include "particle_surface_tracker/core/particle_grid.h"

namespace particle_surface_tracker::implicit {

/// A first guess of where the liquid is, from counts of particles alone: at the centres of the cells of the particle
/// grid, a node is presumed inside where the 3 × 3 × 3 cells around it are full, outside where they are empty, and
/// requested to be evaluated anywhere else.
/// \param particle_spacing r [m].
NodeLattice guess_coarse_signs(const ParticleGrid& particles, double particle_spacing);

}  // namespace particle_surface_tracker::implicit
