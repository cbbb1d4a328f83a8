#pragma once

#include "particle_surface_tracker/core/particle_frame.h"
#include "particle_surface_tracker/core/triangle_mesh.h"
#include "simulator_parameters.h"

namespace particle_surface_tracker::simulator {

/// Something to simulate, and the detailed mesh that bounds its liquid in the first frame.
struct Scene {
  TriangleMesh mesh;
  ParticleFrame particles;
  SimulatorParameters parameters;
};

/// What suits the falling ring: about 14,000 particles of a liquid so thick that its detail lasts, on slippery ground.
SimulatorParameters falling_ring_parameters();

/// The scaly ring, tilted above a ball onto which it falls: it drapes over the ball, splits, flows around it and
/// merges behind it, and its hole closes.
/// \param parameters with a spacing r from 0.01 to 0.075 m; the ring's tube is 0.4 m thick. The ball is added to the
/// obstacles.
/// \throw ParameterError if r is out of this range.
Scene falling_ring(SimulatorParameters parameters);

}  // namespace particle_surface_tracker::simulator
