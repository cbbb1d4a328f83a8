#include "particle_surface_tracker/tracker/tracker_state.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/mesh_validation.h"

namespace particle_surface_tracker {

namespace {

void check_particles(const ParticleFrame& particles) {
  if (particles.empty()) throw ParticleError("there are no particles");
  make_particle_frame(particles.stamp_ns, particles.positions, particles.ids, particles.velocities);
  if (!std::is_sorted(particles.ids.begin(), particles.ids.end())) {
    throw ParticleError("the particles are not in the order of their ids");
  }
}

void check_mesh(const TriangleMesh& mesh) {
  // All liquid may have gone, and the mesh with it.
  if (mesh.vertex_count() == 0 && mesh.triangle_count() == 0) return;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    if (!mesh.positions()[v].allFinite()) throw MeshError(fmt::format("the position of vertex {} is not finite", v));
  }
  check_closed_manifold(mesh);
}

void check_detection(const Detection& detection, std::size_t vertex_count) {
  const auto& flagged = detection.flagged_vertices;
  const bool is_list = std::adjacent_find(flagged.begin(), flagged.end(), std::greater_equal<>()) == flagged.end();
  if (!is_list || (!flagged.empty() && flagged.back() >= vertex_count)) {
    throw TrackingError(fmt::format("the flagged vertices are no increasing indices below {}", vertex_count));
  }
}

}  // namespace

void check_tracker_state(const TrackerState& state) {
  check_parameters(state.parameters);
  check_particles(state.frame.particles);
  check_mesh(state.frame.mesh);
  check_detection(state.frame.detection, state.frame.mesh.vertex_count());
  if (!std::isfinite(state.frame.band) || state.frame.band < 0.0) {
    throw TrackingError(fmt::format("the largest distance between mesh and isosurface is {} m", state.frame.band));
  }
  if (state.frame.original_vertices > state.frame.mesh.next_id()) {
    throw TrackingError(fmt::format("the first mesh has {} vertices, but only {} ids were ever given",
                                    state.frame.original_vertices, state.frame.mesh.next_id()));
  }
}

}  // namespace particle_surface_tracker
