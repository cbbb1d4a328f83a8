#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "particle_surface_tracker/core/vertex_components.h"
#include "triangle_cuts.h"

namespace particle_surface_tracker::remeshing {

/// Components of the mesh that cross no edge of the lattice, so that Γ does not know of them.
struct SmallComponents {
  std::vector<std::uint32_t> kept;     ///< Triangles of those that φ confirms, increasing.
  std::vector<std::uint32_t> removed;  ///< ... and of the others.
  std::size_t kept_count = 0;          ///< Components.
  std::size_t removed_count = 0;

  /// True if the triangle belongs to one of them.
  bool contain(std::uint32_t triangle) const;
};

/// Finds them. A drop stays where the mesh does not wind around any of the nodes around it and one of these is in
/// liquid; a bubble where the mesh winds once around all of them and one is not in liquid.
/// \param components of the mesh.
/// \param is_liquid true where φ < 0 at a node; may be empty: nothing speaks for liquid.
SmallComponents find_small_components(TriangleCuts& cuts, const VertexComponents& components,
                                      const std::function<bool(const openvdb::Coord&)>& is_liquid);

}  // namespace particle_surface_tracker::remeshing
