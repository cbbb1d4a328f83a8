#pragma once

#include <memory>
#include <vector>

#include <openvdb/openvdb.h>
#include <particle_surface_tracker/TrackedMesh.h>

#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/core/topology_cells.h"
#include "particle_surface_tracker/core/topology_events.h"

namespace particle_surface_tracker {

/// All that markers show of a tracked frame. Nothing in it is touched again.
struct TrackedView {
  TrackedMeshConstPtr mesh;
  std::shared_ptr<const ImplicitSurface> surface;
  double r = 0.0;                              ///< Particle spacing [m].
  double cell_size = 0.0;                      ///< Δx_Γ [m].
  std::vector<openvdb::Coord> flagged_cells;   ///< Of Γ: with a vertex that was flagged.
  std::vector<openvdb::Coord> remeshed_cells;  ///< Of Γ: in which re-meshing made vertices.
  std::shared_ptr<const TopologyCells> cells;  ///< Null where nobody wants to see them.
  std::vector<TopologyEvent> events;
};

}  // namespace particle_surface_tracker
