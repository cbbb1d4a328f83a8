#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// Removes the components of a mesh that bound no liquid: small solids whose box no particle is in or within 0.3 r
/// of. Such crumbs come from φ, which can be below 0 midway between particles that are far from it, and from detail
/// that is cut off. Components with a vertex of the first mesh stay unless they have been cut in this frame; cavities
/// and what may hold one stay.
/// \param first_new_id ids from here on were not in the first mesh.
/// \param first_fresh_id ids from here on are of this frame.
/// \param r particle spacing [m].
/// \return the number of components that were removed.
std::size_t remove_empty_components(TriangleMesh& mesh, std::uint32_t first_new_id, std::uint32_t first_fresh_id,
                                    const std::vector<Vec3f>& particles, double r);

}  // namespace particle_surface_tracker
