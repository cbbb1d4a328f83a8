#pragma once

#include <vector>

#include <openvdb/Types.h>

#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// Finds where the pieces of the mesh are not those of the isosurface although no vertex moves far and no node of Γ is
/// on the wrong side: a thread of mesh that holds two drops together which have come apart, and a scrap of mesh that
/// has lost its liquid, or broke off a body that is still whole.
///
/// A vertex belongs to the component of φ = 0 that is nearest along the lattice. Flagged are triangles whose vertices
/// belong to different components, and all triangles of a small component of the mesh that belongs to a component of
/// φ = 0 which another one of the mesh covers better. Bridges and scraps that the first mesh was born with are left
/// alone: details may be thinner than the liquid can resolve.
/// \param first_new_id ids from here on were not in the first mesh.
/// \return cells of Γ, sorted, unique; none where `detection` is kTau, or mesh and isosurface are of one piece.
std::vector<openvdb::Coord> find_component_disagreement(const TriangleMesh& mesh, std::uint32_t first_new_id,
                                                        const ImplicitSurface& surface, const Parameters& parameters);

/// Notes which vertices are part of a bridge between components of φ = 0 now, at the birth of the mesh.
void note_bridges(TriangleMesh& mesh, const ImplicitSurface& surface);

}  // namespace particle_surface_tracker
