#pragma once

#include <cstddef>
#include <vector>

#include <openvdb/Types.h>

#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/topology_cells.h"
#include "particle_surface_tracker/stages/isosurface_query.h"
#include "particle_surface_tracker/stages/mesh_query.h"

namespace particle_surface_tracker {

/// What topology matching had to do.
struct MatchingStatistics {
  std::size_t flagged_nodes = 0;  ///< Nodes of Γ at flagged cells.
  std::size_t unknowns = 0;       ///< Nodes solved for.
  std::size_t free_unknowns = 0;  ///< Of these: connected to no fixed node, so that Γ is φ.
  std::size_t fixed = 0;          ///< Fixed nodes next to an unknown.
  int iterations = 0;             ///< Of the solver, all rounds.
  int enlargements = 0;           ///< How often the region was too small.
  double residual = 0.0;          ///< Largest difference of ψ at an unknown from the mean of its neighbours [m].
  bool converged = true;          ///< False where the solver ran out of iterations.
};

/// Γ where its topology was matched to that of φ. Everywhere else it is the signed distance of the mesh.
struct MatchedVoxelization {
  std::vector<openvdb::Coord> nodes;    ///< The unknowns, sorted.
  std::vector<float> gamma;             ///< New Γ there [m]; below 0 is inside.
  std::vector<openvdb::Coord> changed;  ///< The nodes of them whose side differs from the mesh's, sorted.
  MatchingStatistics statistics;
};

/// Matches the topology of Γ to that of φ (Sec. 6, Algorithm 1): where the mesh is not trusted, Γ = φ + ψ with the
/// smoothest ψ that takes the values Γ − φ at the fixed nodes around.
///
/// Unknown are the nodes within matching_reach of a flagged node (one at a flagged cell) that are not fixed. Fixed is a
/// node that is not flagged, around which the mesh winds 0 or 1 times, and that has a node of the other side among its
/// 26 neighbours (so that |Γ| ≤ h√3). Where Γ changes sides near the rim of that region, the region grows there.
/// Without flagged cells nothing is done, unless matching_frames asks for it: then all nodes within matching_reach of
/// mesh or isosurface are looked at.
/// \param mesh by its lattice.
/// \param isosurface of the frame that the mesh is now in.
/// \param flagged_cells cells of Γ.
/// \param at_conflicts nodes where Γ gets the side of φ, whatever the mesh says: ψ counts where it leads away from the
/// other side, and is 0 where it does not. They count as flagged.
/// \param record receives ψ at fixed nodes and unknowns; null: nothing is recorded.
/// \throw TrackingError if the whole domain is asked for (matching_reach 0) and has more than 2^28 nodes.
MatchedVoxelization match_topology(const MeshQuery& mesh, const IsosurfaceQuery& isosurface,
                                   const std::vector<openvdb::Coord>& flagged_cells, const Parameters& parameters,
                                   const std::vector<openvdb::Coord>& at_conflicts = {},
                                   TopologyCells* record = nullptr);

}  // namespace particle_surface_tracker
