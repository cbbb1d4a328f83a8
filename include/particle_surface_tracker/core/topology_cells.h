#pragma once

#include <vector>

#include <openvdb/Types.h>

namespace particle_surface_tracker {

/// Nodes of Γ, sorted, with a value each.
struct NodeValues {
  std::vector<openvdb::Coord> nodes;
  std::vector<float> values;
};

/// What topology matching and re-meshing made of the cells and nodes of Γ in one frame (Secs. 5.3, 6, 7), to be looked
/// at. Cell c has its lowest corner at node c, node (i, j, k) is at (i, j, k) · cell_size. All lists are sorted, each
/// cell once; of a frame that was matched several times they hold all times.
struct TopologyCells {
  double cell_size = 0.0;               ///< Δx_Γ [m].
  std::vector<openvdb::Coord> flagged;  ///< To be made anew from the start.
  std::vector<openvdb::Coord> complex;  ///< With an edge that is crossed twice or more, or around a node that the mesh
                                        ///< winds around neither 0 times nor once.
  std::vector<openvdb::Coord> tangled;  ///< Of these: sheets overlap.
  std::vector<openvdb::Coord> deep;     ///< The mesh is thinner in them than Γ can see.
  std::vector<openvdb::Coord> marked;   ///< Made anew, for whatever reason.
  std::vector<openvdb::Coord> front;    ///< Of these: the mesh goes on from them into a cell that is not marked.
  std::vector<openvdb::Coord> changed_nodes;  ///< Nodes that changed sides.
  NodeValues fixed;                           ///< ψ = Γ − φ at the fixed nodes next to an unknown [m].
  NodeValues unknown;                         ///< ψ that was solved for [m].

  /// Puts in what another time has. Where both have ψ the other's stays.
  void add(const TopologyCells& other);
};

}  // namespace particle_surface_tracker
