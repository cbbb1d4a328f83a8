#pragma once

#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/types.h"
#include "stages/nodes/node_masks.h"

namespace particle_surface_tracker {

/// The vertices of a mesh that may be near a set of lattice nodes, in blocks of 2³ nodes: most of a mesh is nowhere
/// near.
class NearVertices {
 public:
  /// \param h distance of the nodes [m].
  /// \param reach [m].
  NearVertices(const std::vector<Vec3f>& positions, const NodeMasks& set, double h, double reach);

  /// False if no node of the set is within the reach of a vertex, along every axis.
  bool may_be_near(std::uint32_t vertex) const { return is_near_[vertex] != 0; }

 private:
  std::vector<char> is_near_;
};

}  // namespace particle_surface_tracker
