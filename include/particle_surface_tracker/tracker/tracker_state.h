#pragma once

#include <cstddef>
#include <cstdint>

#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/particle_frame.h"
#include "particle_surface_tracker/core/triangle_mesh.h"
#include "particle_surface_tracker/stages/detection.h"

namespace particle_surface_tracker {

/// What a frame leaves behind for the next one.
struct TrackedFrame {
  TriangleMesh mesh;
  ParticleFrame particles;            ///< Of the last frame that had any.
  std::uint64_t particles_frame = 0;  ///< The index of that frame.
  Detection detection;
  double band = 0.0;                  ///< Largest distance between mesh and isosurface, flagged vertices left out [m].
  std::size_t original_vertices = 0;  ///< Vertices of the first mesh have ids below it.
};

/// Everything that a tracker goes on from. The implicit surface is no part of it: particles and parameters give the
/// same one again, bit for bit.
struct TrackerState {
  Parameters parameters;
  TrackedFrame frame;
};

/// Checks that all parts are sound and fit each other, as those of a tracker do.
/// \throw ParameterError, ParticleError, MeshError as the checks of parameters, particle frames and meshes.
/// \throw TrackingError if flagged vertices or the band cannot be those of this mesh.
void check_tracker_state(const TrackerState& state);

}  // namespace particle_surface_tracker
