#pragma once

#include "implicit_kernel.h"
#include "particle_surface_tracker/core/particle_grid.h"

namespace particle_surface_tracker::implicit {

/// Lists runs of the sorted particles that hold all of those nearer than R to a box, and some more.
/// \param frame in which the box is given.
/// \return the number of particles in them.
std::size_t list_particles_near(const ParticleGrid& particles, const Frame& frame, const Box& box, WorldPoints& world);

}  // namespace particle_surface_tracker::implicit
