#pragma once

#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/types.h"

// Questions about triangles of finite positions, answered exactly.

namespace particle_surface_tracker {

/// Whether the three corners lie on a line.
bool is_flat(const std::vector<Vec3f>& positions, const Triangle& triangle);

/// Whether two triangles that are not flat meet in more than the vertices and edges that they share by index; always
/// true of two triangles of the same vertices.
bool meet_beyond_shared(const std::vector<Vec3f>& positions, const Triangle& first, const Triangle& second);

/// +1 where a ray from a point along +z leaves through the front of the triangle, −1 where it enters through its back,
/// else 0. Edges and corners that the ray hits count for one of their triangles only, so that the sum over the
/// triangles of a closed mesh is how often it winds around the point. A triangle that the point lies on is not crossed.
int crossing_above(const std::vector<Vec3f>& positions, const Triangle& triangle, const Vec3f& point);

}  // namespace particle_surface_tracker
