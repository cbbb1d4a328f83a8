#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// The particles of one instant as a structure of arrays, ordered by id.
///
/// Simulators sort their arrays and recycle ids, so a particle is found again by its id only. Keeping every frame in
/// the order of the ids makes matching two frames a merge, and makes every result independent of the order of the
/// input.
struct ParticleFrame {
  std::int64_t stamp_ns = 0;       ///< Time of the frame [ns].
  std::vector<Vec3f> positions;    ///< Centres [m].
  std::vector<std::uint32_t> ids;  ///< Strictly increasing, one per position.
  std::vector<Vec3f> velocities;   ///< [m/s], one per position, or empty.

  std::size_t size() const { return positions.size(); }
  bool empty() const { return positions.empty(); }
};

/// Orders the arrays by id and checks them.
///
/// \param ids one per position, in any order.
/// \param velocities one per position, or empty.
/// \throw ParticleError if the lengths differ, a position or velocity is not finite, or an id occurs twice. The text
/// names how many there are and the first of them.
ParticleFrame make_particle_frame(std::int64_t stamp_ns, std::vector<Vec3f> positions, std::vector<std::uint32_t> ids,
                                  std::vector<Vec3f> velocities = {});

/// The spacing r of the particles [m]: the median over the particles of the distance to the nearest other one.
///
/// For a cubic grid that is the grid constant; for the disordered particles of a running simulation it is a little
/// less.
/// \throw ParticleError with fewer than two distinct positions.
double estimate_particle_spacing(const ParticleFrame& frame);

}  // namespace particle_surface_tracker
