#pragma once

#include <array>
#include <cstdint>

#include "cell_loops.h"

namespace particle_surface_tracker {

/// Triangles that fill the loops of a cell, each as a disc. Diagonals run only between points that share no face of the
/// cell, because the cell on the other side of a face could use the same one: four triangles would meet there. With the
/// inside corners kept apart on ambiguous faces every loop of the 256 patterns has such a triangulation.
struct LoopFilling {
  using Triangle = std::array<std::uint8_t, 3>;

  int triangle_count = 0;
  std::array<Triangle, kCellEdges> triangles{};  ///< Of edges of the cell, each standing for the point on it.
};

/// The filling for each of the 256 patterns of signs, made once.
const std::array<LoopFilling, 256>& loop_fillings();

}  // namespace particle_surface_tracker
