#pragma once

#include <cstddef>
#include <vector>

#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/particle_frame.h"
#include "particle_surface_tracker/core/particle_grid.h"
#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// Displacements of the particles that two frames have in common, at their places in the earlier frame.
struct ParticleMotion {
  std::vector<Vec3f> positions;      ///< Of the earlier frame [m], in the order of the ids.
  std::vector<Vec3f> displacements;  ///< To the later frame [m].
  std::size_t born = 0;              ///< In the later frame only, or teleported.
  std::size_t gone = 0;              ///< In the earlier frame only, or teleported.
};

/// Matches particles by id (Sec. 4). One that moved farther than max_displacement is a death and a birth: ids get
/// recycled.
ParticleMotion match_particles(const ParticleFrame& earlier, const ParticleFrame& later, const Parameters& parameters);

/// Carries vertices along with the particles around them (Sec. 4, poly6 kernel, weights at the earlier time).
///
/// kAverage is the paper's weighted average of displacements. kAffine fits a first-order motion to the same neighbours:
/// exact for rigid motion, bounded where bodies collide (docs/advection.md). With no particle within the radius, the
/// radius is expanded until there is one. With no motion at all (no common particle) the vertices stay. \param grid the
/// positions of `motion` sorted into cells of about r. \return the new positions [m].
std::vector<Vec3f> advect(const std::vector<Vec3f>& vertices, const ParticleMotion& motion, const ParticleGrid& grid,
                          const Parameters& parameters);

}  // namespace particle_surface_tracker
