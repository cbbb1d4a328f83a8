#pragma once

#include "stages/nodes/leaf_masks.h"

namespace particle_surface_tracker {

/// The nodes of a leaf of 8³ whose values are at most a limit.
LeafWords nodes_at_most(const float* values, float limit);

/// The nodes of a leaf of 8³ whose values are not negative.
LeafWords nodes_at_least_zero(const float* values);

/// From squared distances to signed ones, a leaf at a time.
/// \param squared [cells²].
/// \param inside nodes that get negative ones.
/// \param outside nodes that get positive ones; all others are absent.
/// \param values the signed distances [m].
void sign_values(const float* squared, const LeafWords& inside, const LeafWords& outside, float dx, float* values);

}  // namespace particle_surface_tracker
