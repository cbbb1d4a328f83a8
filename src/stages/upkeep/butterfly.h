#pragma once

#include <cstdint>

#include "editable_surface.h"

namespace particle_surface_tracker {

Vec3d edge_midpoint(const EditableSurface& surface, std::uint32_t half_edge);

/// Where the modified butterfly scheme puts a new vertex on an edge (Sec. 8; Zorin et al. 1996): the eight-point
/// stencil between two vertices of valence 6, else the stencil around the end whose valence is not 6, else the mean of
/// both.
Vec3d butterfly_position(const EditableSurface& surface, std::uint32_t half_edge);

}  // namespace particle_surface_tracker
