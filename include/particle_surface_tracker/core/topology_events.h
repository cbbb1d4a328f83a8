#pragma once

#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/types.h"
#include "particle_surface_tracker/core/vertex_components.h"

namespace particle_surface_tracker {

/// A piece of the mesh that came off another one, joined one, or went.
struct TopologyEvent {
  enum class Kind { kSplit, kMerge, kGone };
  Kind kind = Kind::kSplit;
  Vec3f place = Vec3f::Zero();  ///< Near the cut or seam [m].
};

/// A mesh whose vertices can be found again by their ids.
struct IdentifiedMesh {
  const std::vector<std::uint32_t>& ids;  ///< One for each vertex, none twice.
  const std::vector<Vec3f>& positions;    ///< [m]
  const VertexComponents& components;
};

/// Compares the components of two meshes of one run by the ids of their vertices. Of the pieces that one component
/// falls into, all but the largest have split off; of the components that one is made of, all but the largest have
/// joined it. A piece of new vertices only belongs to the component nearest to it.
/// \param reach a component none of whose vertices is left has joined what is nearer to it than this [m], else it has
/// gone.
std::vector<TopologyEvent> find_topology_events(const IdentifiedMesh& before, const IdentifiedMesh& after,
                                                double reach);

}  // namespace particle_surface_tracker
