#pragma once

#include <cmath>

#include <openvdb/Types.h>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// Positions farther than this from the origin of the world have no cell [cells].
constexpr double kFarthestCell = 1 << 29;

/// True if a position has a cell [cells].
inline bool has_cell(const Vec3d& position) {
  return position.cwiseAbs().maxCoeff() < kFarthestCell;
}

/// The cell that holds a position that has one [cells].
inline openvdb::Coord cell_of(const Vec3d& position) {
  return {static_cast<int>(std::floor(position.x())), static_cast<int>(std::floor(position.y())),
          static_cast<int>(std::floor(position.z()))};
}

}  // namespace particle_surface_tracker
