#pragma once

#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// Where the vertices of a mesh were.
struct VertexPlaces {
  std::vector<std::uint32_t> ids;
  std::vector<Vec3f> positions;  ///< [m], one per id.
};

/// Displacement of every vertex since it was at the place of its id, over the time between [m/s]. A vertex that is new
/// takes the mean of its neighbours', ring by ring; it is 0 where a whole component is new.
/// \param seconds positive.
std::vector<Vec3f> vertex_velocities(const VertexPlaces& before, const TriangleMesh& mesh, double seconds);

}  // namespace particle_surface_tracker
