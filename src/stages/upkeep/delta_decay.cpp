#include <cmath>

#include "particle_surface_tracker/stages/upkeep.h"

namespace particle_surface_tracker {

void decay_delta(TriangleMesh& mesh, double elapsed_seconds, const Parameters& parameters) {
  if (parameters.delta_half_life <= 0.0 || !(elapsed_seconds > 0.0)) return;
  const double factor = std::exp2(-elapsed_seconds / parameters.delta_half_life);
  for (float& delta : mesh.delta()) delta = static_cast<float>(factor * delta);
}

}  // namespace particle_surface_tracker
