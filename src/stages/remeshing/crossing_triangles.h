#pragma once

#include <vector>

#include "particle_surface_tracker/stages/mesh_lattice.h"

namespace particle_surface_tracker::remeshing {

/// Cells in which a triangle crosses another one that it shares no edge with, however far apart they are on the mesh;
/// exact, but where a crossing lies next to a cell that both triangles meet that cell may be among them. Sorted, the
/// same for any number of threads.
std::vector<openvdb::Coord> find_crossing_cells(const MeshLattice& lattice);

}  // namespace particle_surface_tracker::remeshing
