#pragma once

#include <cstdint>
#include <vector>

namespace particle_surface_tracker {

/// What is opposite to each half-edge of a mesh, kept while its triangles stay. Half-edge 3 t + k runs from corner k of
/// triangle t to the next corner.
struct MeshTwins {
  std::vector<std::uint32_t> of_half_edges;
  std::uint64_t connectivity = 0;  ///< TriangleMesh::connectivity() of the mesh that they belong to; 0: of none.
};

}  // namespace particle_surface_tracker
