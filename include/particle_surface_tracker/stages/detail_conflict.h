#pragma once

#include <vector>

#include <openvdb/Types.h>

#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/triangle_mesh.h"
#include "particle_surface_tracker/stages/component_disagreement.h"
#include "particle_surface_tracker/stages/isosurface_query.h"
#include "particle_surface_tracker/stages/mesh_query.h"
#include "particle_surface_tracker/stages/topology_matching.h"

namespace particle_surface_tracker {

/// Particles of a frame that the mesh does not hold: they are outside and farther than `reach` from it.
/// \param particles [m].
/// \param mesh_query the mesh before `matched`.
/// \param matched what became of Γ since; empty if nothing did.
/// \param mesh as it is now.
/// \param reach [m].
/// \return their positions [m], in the order of the particles; none where `detection` is kTau.
std::vector<Vec3f> find_uncovered_particles(const std::vector<Vec3f>& particles, const MeshQuery& mesh_query,
                                            const MatchedVoxelization& matched, const TriangleMesh& mesh, double reach,
                                            const Parameters& parameters);

/// Those of some uncovered particles near which there is liquid of φ that is not in the mesh.
std::vector<Vec3f> near_missing_liquid(const std::vector<Vec3f>& uncovered, const MeshQuery& mesh_query,
                                       const MatchedVoxelization& matched, const IsosurfaceQuery& isosurface,
                                       const Parameters& parameters);

/// Nodes of Γ where detail and topology cannot both be had, so that Γ has to have the side of φ: around particles that
/// the mesh does not hold, in scraps of mesh that belong to a body, and along the shortest way through liquid from
/// these, and from larger pieces that belong to a body, to the rest of the mesh.
/// \param mesh_query the mesh.
/// \param uncovered particles [m].
/// \return sorted, unique.
std::vector<openvdb::Coord> find_conflicting_nodes(const MeshQuery& mesh_query, const ComponentDisagreement& pieces,
                                                   const std::vector<Vec3f>& uncovered,
                                                   const IsosurfaceQuery& isosurface, const Parameters& parameters);

/// Cells with films of air in them that Γ cannot see: around lattice edges that the mesh crosses, but between whose
/// ends, both of them nodes that have the side of φ, there is to be liquid. A piece that is joined along them stays
/// apart unless they are made anew.
/// \param at_conflicts the nodes that have the side of φ, sorted.
/// \param matched Γ there.
/// \return sorted, unique.
std::vector<openvdb::Coord> find_hidden_films(const MeshLattice& lattice,
                                              const std::vector<openvdb::Coord>& at_conflicts,
                                              const MatchedVoxelization& matched);

}  // namespace particle_surface_tracker
