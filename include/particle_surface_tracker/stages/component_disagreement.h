#pragma once

#include <vector>

#include <openvdb/Types.h>

#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/triangle_mesh.h"
#include "particle_surface_tracker/stages/isosurface_query.h"

namespace particle_surface_tracker {

/// Cells of Γ where the pieces of the mesh are not those of the isosurface; sorted, unique.
struct ComponentDisagreement {
  std::vector<openvdb::Coord> bridge_cells;  ///< Of triangles that hold together what has come apart.
  std::vector<openvdb::Coord> scrap_cells;   ///< Of small components that should not be, or not be on their own.
  std::vector<openvdb::Coord> stray_cells;   ///< Of larger ones that should not be on their own.

  bool none() const { return bridge_cells.empty() && scrap_cells.empty() && stray_cells.empty(); }
};

/// Finds where the pieces of the mesh are not those of the isosurface although no vertex moves far and no node of Γ is
/// on the wrong side: a thread of mesh that holds two drops together which have come apart, and a scrap of mesh that
/// has lost its liquid, or broke off a body that is still whole.
///
/// A vertex belongs to the component of φ = 0 that is nearest along the lattice. Flagged are triangles whose vertices
/// belong to different components that their piece of the mesh holds together, if need be through components too small
/// to count on their own, and all triangles of a small component of the mesh that belongs to a component of
/// φ = 0 which another one of the mesh covers better. Bridges and scraps that the first mesh was born with are left
/// alone: details may be thinner than the liquid can resolve.
/// \param first_new_id ids from here on were not in the first mesh.
/// \return nothing where `detection` is kTau.
ComponentDisagreement find_component_disagreement(const TriangleMesh& mesh, std::uint32_t first_new_id,
                                                  const IsosurfaceQuery& isosurface, const Parameters& parameters);

/// Notes which vertices are part of a bridge between components of φ = 0 now, at the birth of the mesh.
void note_bridges(TriangleMesh& mesh, const IsosurfaceQuery& isosurface);

}  // namespace particle_surface_tracker
