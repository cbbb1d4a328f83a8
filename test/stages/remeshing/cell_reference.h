#pragma once

#include "particle_surface_tracker/core/topology_cells.h"
#include "particle_surface_tracker/core/triangle_mesh.h"
#include "particle_surface_tracker/stages/remeshing.h"

namespace particle_surface_tracker::test {

/// The cells of each kind that re-meshing is to find, by asking every cell, edge and face about every triangle. Shares
/// no code with the library; intersections are CGAL's. Of a closed mesh in general position: no vertex, edge or
/// triangle touches a node, an edge or a plane of the lattice that it does not cross.
TopologyCells find_cells_by_force(const TriangleMesh& mesh, double h, const RemeshingRequest& request);

}  // namespace particle_surface_tracker::test
