#pragma once

#include <vector>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// The outward unit normal of every vertex: the normals of its triangles, weighted by their angle at the vertex. So it
/// hardly depends on how the surface is cut into triangles. It is zero where all triangles of a vertex are degenerate.
std::vector<Vec3f> vertex_normals(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles);

}  // namespace particle_surface_tracker
