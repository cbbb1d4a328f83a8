#pragma once

#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// Ids of some vertices: those outlast what changes the order of vertices, and increase with the vertex.
std::vector<std::uint32_t> ids_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& vertices);

/// The vertices with some ids, as far as they are alive.
std::vector<std::uint32_t> vertices_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& ids);

}  // namespace particle_surface_tracker
