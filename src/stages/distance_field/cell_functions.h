#pragma once

#include <cstdint>

#include "patch_kernel.h"
#include "surface_cells.h"

namespace particle_surface_tracker {

/// The faces of some triangles of a cell, at most CellFunctions::max_faces, and those of their edges that run from a
/// vertex to one with a larger number: every edge of the closed surface does so in one of its two triangles.
CellFunctions make_cell_functions(const SurfaceCells& cells, const openvdb::Coord& corner, std::uint32_t first_triangle,
                                  std::uint32_t last_triangle);

}  // namespace particle_surface_tracker
