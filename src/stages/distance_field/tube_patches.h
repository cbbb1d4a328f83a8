#pragma once

#include <vector>

#include "patch_kernel.h"
#include "surface_cells.h"

namespace particle_surface_tracker {

/// Lists patches of the block of a cell's leaf that together hold all of the block's nodes whose closest place on the
/// isosurface may be in the cell.
/// \param corner of the cell, relative to that of its leaf [cells].
/// \param height distance from the isosurface up to which the nodes are wanted [cells].
/// \return how the patches lie: their slices across the lattice axis closest to the cell's normal.
PatchAxes list_patches(const CellBounds& cell, const openvdb::Coord& corner, float height, std::vector<Patch>& patches);

}  // namespace particle_surface_tracker
