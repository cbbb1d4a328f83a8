#pragma once

#include <vector>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// How often a closed mesh winds around each of some points: 0 outside, 1 inside, 0 in a cavity. Counted along the ray
/// in the direction of x.
/// \param cell_size of the bins that triangles are sorted into [m]: of the size of the mesh's details.
std::vector<int> winding_numbers(const TriangleMesh& mesh, const std::vector<Vec3f>& points, double cell_size);

}  // namespace particle_surface_tracker
