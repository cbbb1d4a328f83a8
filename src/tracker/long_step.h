#pragma once

#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/types.h"
#include "particle_surface_tracker/stages/advection.h"

namespace particle_surface_tracker {

/// In how many steps vertices are to be carried along with a motion, from 1 to 16: as many as there are frames in it,
/// and so many that only few particles move farther than 4 r in one. Neighbours are found anew in every step, which
/// matters where a long way takes particles past each other.
/// \param elapsed frames between the two that the motion connects, at least 1.
int steps_for(const ParticleMotion& motion, std::uint64_t elapsed, const Parameters& parameters);

/// Carries vertices along with particles that go their way on straight lines, in steps of the same length. One step is
/// advect() itself, bit for bit.
/// \return the new positions [m].
std::vector<Vec3f> advect_in_steps(const std::vector<Vec3f>& vertices, const ParticleMotion& motion, int steps,
                                   const Parameters& parameters);

}  // namespace particle_surface_tracker
