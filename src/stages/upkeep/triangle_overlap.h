#pragma once

#include "particle_surface_tracker/core/types.h"
#include "triangle_shape.h"

namespace particle_surface_tracker {

/// Whether two triangles have a point in common, by separating axes in double precision: touching counts, and so does
/// what rounding cannot tell from touching. A triangle may be degenerate, for instance a segment.
bool triangles_touch(const Corners& first, const Corners& second);

/// Whether two triangles that share corner 0, and nothing else by index, have more in common than it.
bool triangles_cross_at_shared_corner(const Corners& a, const Corners& b);

}  // namespace particle_surface_tracker
