#pragma once

#include <cstddef>

#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/particle_frame.h"
#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// A mesh and a cubic grid of particles that fills it.
struct FilledBody {
  TriangleMesh mesh;
  ParticleFrame particles;
  Parameters parameters;  ///< Defaults, with the spacing of the grid.
};

/// Fills a mesh with about `particle_count` particles at least 0.1 r inside.
FilledBody fill_body(const TriangleMesh& mesh, std::size_t particle_count);

/// Particles turned by 0.03 rad around an axis far from the origin's, as a frame after this one.
ParticleFrame next_frame(const ParticleFrame& particles);

}  // namespace particle_surface_tracker
