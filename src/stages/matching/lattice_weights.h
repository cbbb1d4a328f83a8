#pragma once

#include <cmath>

#include <openvdb/Types.h>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// Where a node of one lattice lies on another: in which cell, and where in it, in [0, 1].
struct LatticePlace {
  openvdb::Coord cell;
  Vec3d within;

  /// \param ratio spacing of the node's lattice over that of the other.
  LatticePlace(const openvdb::Coord& node, double ratio) {
    for (int axis = 0; axis < 3; ++axis) {
      const double place = ratio * node[axis];
      cell[axis] = static_cast<int>(std::floor(place));
      within[axis] = place - cell[axis];
    }
  }

  /// The same in a cell that is known to hold it, at its border maybe.
  LatticePlace(const openvdb::Coord& node, double ratio, const openvdb::Coord& in_cell) : cell(in_cell) {
    for (int axis = 0; axis < 3; ++axis) within[axis] = ratio * node[axis] - cell[axis];
  }

  /// Weight of a corner of the cell in linear interpolation; offset is 0 or 1 along each axis.
  double weight(const openvdb::Coord& offset) const {
    double product = 1.0;
    for (int axis = 0; axis < 3; ++axis) product *= offset[axis] != 0 ? within[axis] : 1.0 - within[axis];
    return product;
  }

  /// Calls visit(corner, weight) for the corners that count.
  template <typename Visit>
  void for_each_corner(Visit&& visit) const {
    for (int c = 0; c < 8; ++c) {
      const openvdb::Coord offset(c & 1, c >> 1 & 1, c >> 2);
      const double w = weight(offset);
      if (w > 0.0) visit(cell + offset, w);
    }
  }
};

}  // namespace particle_surface_tracker
