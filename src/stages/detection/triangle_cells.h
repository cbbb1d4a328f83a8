#pragma once

#include <array>
#include <vector>

#include <openvdb/Types.h>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// Appends the cells of the world-anchored lattice of size h [m] that a triangle meets (touching counts). Cell c is the
/// cube from c·h to (c + 1)·h.
void append_triangle_cells(const std::array<Vec3d, 3>& corners, double h, std::vector<openvdb::Coord>& cells);

}  // namespace particle_surface_tracker
