#pragma once

#include <vector>

#include "particle_surface_tracker/stages/mesh_lattice.h"
#include "stages/nodes/node_masks.h"

namespace particle_surface_tracker {

/// The nodes of a set that no triangle's detail explains: they are farther from every triangle than the largest |δ| of
/// its vertices and `slack`.
/// \param delta δ of each vertex of the mesh [m].
/// \param slack [m].
/// \return sorted.
std::vector<openvdb::Coord> nodes_beyond_detail(const NodeMasks& set, const MeshLattice& lattice,
                                                const std::vector<float>& delta, double slack);

}  // namespace particle_surface_tracker
