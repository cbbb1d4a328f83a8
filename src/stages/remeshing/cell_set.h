#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <openvdb/Types.h>

#include "stages/nodes/node_masks.h"

namespace particle_surface_tracker::remeshing {

/// A set of cells that only grows and remembers the order in which they came.
class CellSet {
 public:
  /// \return true if the cell is new.
  bool insert(const openvdb::Coord& cell) {
    if (contains(cell)) return false;
    masks_.insert(cell);
    cells_.push_back(cell);
    return true;
  }

  bool contains(const openvdb::Coord& cell) const { return masks_.contains(cell); }

  /// In the order in which they came.
  const std::vector<openvdb::Coord>& cells() const { return cells_; }

  std::vector<openvdb::Coord> sorted() const {
    std::vector<openvdb::Coord> cells = cells_;
    std::sort(cells.begin(), cells.end());
    return cells;
  }

 private:
  NodeMasks masks_;
  std::vector<openvdb::Coord> cells_;
};

}  // namespace particle_surface_tracker::remeshing
