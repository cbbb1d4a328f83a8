#pragma once

#include <cstdint>

#include "editable_surface.h"

namespace particle_surface_tracker {

/// Number of directions in which the normals around a vertex spread: 1 on a smooth part, 2 on a ridge, 3 at a corner
/// (Brochu and Bridson 2009, after Jiao 2007).
int vertex_rank(const EditableSurface& surface, std::uint32_t vertex);

}  // namespace particle_surface_tracker
