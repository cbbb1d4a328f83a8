#pragma once

#include <cstdint>

#include <openvdb/Types.h>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// Positions farther than this from the origin of the world have no cell [cells].
constexpr double kFarthestCell = 1 << 29;

/// True if a position has a cell [cells].
inline bool has_cell(const Vec3d& position) {
  return position.cwiseAbs().maxCoeff() < kFarthestCell;
}

/// The largest whole number not above x, which must be one of 32 bits; std::floor is a function call on plain x86-64.
inline std::int32_t floor_of(double x) {
  const auto truncated = static_cast<std::int32_t>(x);
  return truncated - (x < static_cast<double>(truncated) ? 1 : 0);
}

/// The cell that holds a position that has one [cells].
inline openvdb::Coord cell_of(const Vec3d& position) {
  return {floor_of(position.x()), floor_of(position.y()), floor_of(position.z())};
}

}  // namespace particle_surface_tracker
