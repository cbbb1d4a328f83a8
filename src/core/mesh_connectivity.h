#pragma once

#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/mesh_check.h"

namespace particle_surface_tracker {

/// What is wrong with the edges and vertices of a mesh.
struct MeshConnectivity {
  MeshDefects defects;  ///< Duplicate triangles, and those of edges and vertices; the others are left empty.

  enum VertexState : std::uint8_t { kGood = 0, kBadEdge, kSeveralUmbrellas };
  std::vector<VertexState> vertex_states;
};

/// \param triangles of three different vertices that are there.
MeshConnectivity examine_connectivity(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles);

}  // namespace particle_surface_tracker
