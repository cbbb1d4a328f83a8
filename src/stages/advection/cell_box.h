#pragma once

#include <algorithm>

#include "particle_surface_tracker/core/lattice_index.h"

namespace particle_surface_tracker {

/// A box of cells, both ends included.
struct CellBox {
  LatticeCoord lower;
  LatticeCoord upper;

  /// The smallest box that also holds a cell.
  CellBox with(const LatticeCoord& cell) const {
    CellBox box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = std::min(lower[axis], cell[axis]);
      box.upper[axis] = std::max(upper[axis], cell[axis]);
    }
    return box;
  }

  int volume() const { return (upper[0] - lower[0] + 1) * (upper[1] - lower[1] + 1) * (upper[2] - lower[2] + 1); }
};

}  // namespace particle_surface_tracker
