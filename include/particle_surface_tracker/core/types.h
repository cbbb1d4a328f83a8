#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace particle_surface_tracker {

/// Positions as they arrive and leave: three 32-bit floats [m]. What is stored is what is published.
using Vec3f = Eigen::Vector3f;

/// Everything computed from positions before it is rounded for storage.
using Vec3d = Eigen::Vector3d;

/// Three vertex indices, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

}  // namespace particle_surface_tracker
