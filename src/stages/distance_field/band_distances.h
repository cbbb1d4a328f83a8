#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <openvdb/Types.h>

#include "patch_kernel.h"
#include "stages/nodes/node_masks.h"
#include "surface_cells.h"

namespace particle_surface_tracker {

/// Squared distances of the nodes of a leaf of 8³ to the isosurface [cells²], z fastest.
using LeafDistances = std::array<float, 512>;

/// Computes the squared distances of nodes [cells²]; those farther than the reach, and those that are not wanted, hold
/// more than its square.
/// \param wanted the nodes to compute.
/// \param reach [cells].
/// \return one entry per leaf of `wanted`.
std::vector<LeafDistances> measure_distances(const SurfaceCells& cells, const NodeMasks& wanted, double reach);

}  // namespace particle_surface_tracker
