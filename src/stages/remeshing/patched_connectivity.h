#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker::remeshing {

class Patch;

/// The triangles of a mesh in which a patch has taken the place of some, and what is opposite to each of their
/// half-edges (stages/upkeep/half_edges.h).
struct PatchedConnectivity {
  std::vector<Triangle> triangles;  ///< First those that were kept, in order, then those of the patch.
  std::vector<std::uint32_t> twins;
};

/// Puts a patch into a mesh, and checks the result where it is not as before: every edge there must have one triangle
/// on either side, every vertex one umbrella of three triangles or more. Of all other triangles and their twins only
/// the numbers change.
/// \param twins of the half-edges of these triangles. Where one is kNoHalfEdge the mesh is taken for open, and what is
/// around the edge is checked too; what has twins is taken for part of a closed, oriented 2-manifold.
/// \return nothing if the result would not be a closed, oriented 2-manifold.
std::optional<PatchedConnectivity> patched_connectivity(const std::vector<Triangle>& triangles,
                                                        const std::vector<std::uint32_t>& twins, const Patch& patch);

}  // namespace particle_surface_tracker::remeshing
