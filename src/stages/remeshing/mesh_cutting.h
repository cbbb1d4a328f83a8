#pragma once

#include <vector>

#include "cell_set.h"
#include "patch.h"
#include "triangle_cuts.h"

namespace particle_surface_tracker::remeshing {

/// Cuts a mesh along the front of the marked cells and keeps what is outside: fills the removed triangles, the front
/// vertices with their places, and what is left of cut triangles.
/// \return cells to be marked before trying again, because a triangle in them cannot be cut; usually none.
std::vector<openvdb::Coord> cut_mesh(TriangleCuts& cuts, const CellSet& marked, Patch& patch);

}  // namespace particle_surface_tracker::remeshing
