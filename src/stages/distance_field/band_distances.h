#pragma once

#include <memory>
#include <vector>

#include <openvdb/openvdb.h>

#include "stages/nodes/node_masks.h"
#include "surface_cells.h"

namespace particle_surface_tracker {

/// A leaf of the field of distances, first of squared ones [cells²].
using DistanceLeaf = std::unique_ptr<openvdb::FloatTree::LeafNodeType>;

/// Computes the squared distances of nodes to the isosurface [cells²]; those farther than the reach hold more than its
/// square. What those hold that are not wanted means nothing.
/// \param wanted the nodes to compute.
/// \param reach [cells].
/// \return one entry per leaf of `wanted`.
std::vector<DistanceLeaf> measure_distances(const SurfaceCells& cells, const NodeMasks& wanted, double reach);

}  // namespace particle_surface_tracker
