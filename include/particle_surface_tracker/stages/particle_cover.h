#pragma once

#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// Brings the surface to within r of particles that it just misses, as at the tip of a jet, which triangles cut off.
/// What is farther than 1.25 r stays where it is, and vertices of the first mesh do so from 1.15 r on: they keep their
/// δ, so that they are back in their places in the next frame. Where the closest triangle cannot move alone, the
/// vertices around it come along, up to two edges away. Nothing is moved so that triangles turn their fronts away,
/// cross each other or pass over something small.
/// \param first_new_id ids from here on were not in the first mesh.
/// \param particles those that may be missed, all of them outside [m].
/// \param r particle spacing [m].
/// \return the vertices that have moved, by at most 0.9 r, but those of the first mesh: increasing indices. Their δ must
/// be measured.
std::vector<std::uint32_t> cover_particles(TriangleMesh& mesh, std::uint32_t first_new_id,
                                           const std::vector<Vec3f>& particles, double r);

}  // namespace particle_surface_tracker
