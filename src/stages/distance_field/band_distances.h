#pragma once

#include "squared_distances.h"
#include "stages/nodes/node_masks.h"
#include "surface_cells.h"

namespace particle_surface_tracker {

/// Computes the squared distances of nodes to the isosurface [cells²]; those farther than the reach hold more than its
/// square. What those hold that are not wanted means nothing.
/// \param wanted the nodes to compute.
/// \param reach [cells].
/// \return those of the leaves of `wanted`.
SquaredDistances measure_distances(const SurfaceCells& cells, const NodeMasks& wanted, double reach);

}  // namespace particle_surface_tracker
