#pragma once

#include <array>
#include <cstdint>

#include "cell_loops.h"

namespace particle_surface_tracker {

/// The numbers of the vertices on the edges of all cells of one leaf: by axis and by the lower node of the edge, one of
/// 9 × 9 × 9.
class EdgeNumbers {
 public:
  /// Where the edges of a cell are found; x, y, z from the corner of the leaf, 0 .. 7.
  static constexpr int cell_place(int x, int y, int z) { return kStride[0] * x + kStride[1] * y + kStride[2] * z; }

  /// \param x, y, z of the lower node, 0 .. 8.
  void set(int axis, int x, int y, int z, std::uint32_t number) {
    numbers_[kNodes * axis + cell_place(x, y, z)] = number;
  }

  /// Number of the vertex on an edge of the cell at a place. It must have been set.
  std::uint32_t at(int cell_place, int edge) const { return numbers_[cell_place + places_[edge]]; }

 private:
  static constexpr int kStride[3] = {81, 9, 1};
  static constexpr int kNodes = 729;

  static std::array<int, kCellEdges> make_places() {
    std::array<int, kCellEdges> places;
    for (int edge = 0; edge < kCellEdges; ++edge) {
      const CellEdge& e = cell_edges()[edge];
      places[edge] = kNodes * e.axis + cell_place(e.lower & 1, e.lower >> 1 & 1, e.lower >> 2);
    }
    return places;
  }

  std::array<int, kCellEdges> places_ = make_places();  ///< From a cell to its edges.
  std::array<std::uint32_t, 3 * kNodes> numbers_;
};

}  // namespace particle_surface_tracker
