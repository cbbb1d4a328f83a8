#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// Removes the components of a mesh that bound no liquid: small solids whose box no particle is in or within 0.3 r
/// of. Such crumbs come from φ, which can be below 0 midway between particles that are far from it. Components with a
/// vertex of the first mesh stay, and so do cavities and what may hold one.
/// \param first_new_id ids from here on were not in the first mesh.
/// \param r particle spacing [m].
/// \return the number of components that were removed.
std::size_t remove_empty_components(TriangleMesh& mesh, std::uint32_t first_new_id, const std::vector<Vec3f>& particles,
                                    double r);

}  // namespace particle_surface_tracker
