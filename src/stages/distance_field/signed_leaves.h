#pragma once

#include <vector>

#include "band_distances.h"
#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/core/signed_distance_field.h"
#include "stages/nodes/node_masks.h"

namespace particle_surface_tracker {

/// Gives distances their signs. Those at the corners of cut cells are φ̃'s; both ends of every edge that the isosurface
/// crosses are such corners, so they can be carried along lattice edges without crossing it.
/// \param squared those of the leaves of `wanted`.
/// \param reach [m].
/// \return the wanted nodes within reach that lattice edges between such nodes connect to a corner of a cut cell.
SignedDistanceField sign_distances(const ImplicitSurface& surface, const NodeMasks& wanted,
                                   const SquaredDistances& squared, double reach);

}  // namespace particle_surface_tracker
