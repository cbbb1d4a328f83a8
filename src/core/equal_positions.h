#pragma once

#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// For each vertex the first one of the same position, bit by bit, but −0 is 0.
std::vector<std::uint32_t> first_of_same_position(const std::vector<Vec3f>& positions);

}  // namespace particle_surface_tracker
