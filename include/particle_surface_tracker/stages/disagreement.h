#pragma once

#include <vector>

#include <openvdb/Types.h>

#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/stages/isosurface_query.h"
#include "particle_surface_tracker/stages/mesh_query.h"

namespace particle_surface_tracker {

/// Where mesh and isosurface disagree about inside and outside and δ does not explain it.
struct Disagreement {
  std::vector<openvdb::Coord> nodes;          ///< Of Γ, sorted.
  std::vector<openvdb::Coord> flagged_cells;  ///< The eight cells around each of them, sorted, unique.
};

/// Finds changes of topology that move no vertex far enough to be noticed (Sec. 9.3): drops and bubbles born away from
/// the mesh, holes inside large triangles, liquid that appears.
///
/// Only nodes next to the isosurface and next to the mesh are looked at (docs/topology_matching.md).
/// \param mesh by its lattice.
/// \param delta δ of each vertex of the mesh [m].
/// \param isosurface of the frame that the mesh is now in.
/// \return nothing where `detection` is kTau.
Disagreement find_disagreement(const MeshQuery& mesh, const std::vector<float>& delta,
                               const IsosurfaceQuery& isosurface, const Parameters& parameters);

}  // namespace particle_surface_tracker
