#pragma once

#include <cstdint>
#include <vector>

#include "mesh_connectivity.h"
#include "particle_surface_tracker/core/mesh_check.h"
#include "triangle_tree.h"

namespace particle_surface_tracker {

/// The components of a mesh, with the component of every vertex (of no use for vertices without triangles).
struct MeshComponents {
  std::vector<MeshComponent> components;
  std::vector<std::uint32_t> of_vertex;
};

/// \param triangles of three different vertices that are there and finite.
/// \param vertex_states as examine_connectivity() gives them.
MeshComponents measure_components(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles,
                                  const std::vector<MeshConnectivity::VertexState>& vertex_states);

/// Fills in MeshComponent::winding_around.
/// \param tree of the triangles that are not flat.
void measure_nesting(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles,
                     const TriangleTree& tree, MeshComponents& components);

}  // namespace particle_surface_tracker
