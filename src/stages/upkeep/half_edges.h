#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "particle_surface_tracker/core/mesh_twins.h"
#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

constexpr std::uint32_t kNoHalfEdge = 0xffffffffU;

inline std::uint32_t next_half_edge(std::uint32_t half_edge) {
  return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

inline std::uint32_t previous_half_edge(std::uint32_t half_edge) {
  return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
}

inline std::uint32_t start_of(const std::vector<Triangle>& triangles, std::uint32_t half_edge) {
  return triangles[half_edge / 3][half_edge % 3];
}

inline std::uint32_t end_of(const std::vector<Triangle>& triangles, std::uint32_t half_edge) {
  return start_of(triangles, next_half_edge(half_edge));
}

/// For every half-edge of a closed, oriented 2-manifold the one that runs the other way on the same edge.
/// \param twins receives them; its memory is used again.
/// \throw MeshError if an edge has not exactly one triangle on either side, or a vertex more than one umbrella.
void pair_half_edges(std::size_t vertex_count, const std::vector<Triangle>& triangles,
                     std::vector<std::uint32_t>& twins);

/// Makes the twins of a mesh, unless they are those of its triangles already.
/// \throw MeshError as pair_half_edges(); `twins` are those of no mesh then.
void update_twins(const TriangleMesh& mesh, MeshTwins& twins);

/// The same, without an exception.
/// \return what is wrong with the mesh, or nothing.
std::string try_to_update_twins(const TriangleMesh& mesh, MeshTwins& twins);

}  // namespace particle_surface_tracker
