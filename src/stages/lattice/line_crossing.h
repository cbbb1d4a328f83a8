#pragma once

#include <cstdint>

#include <openvdb/Types.h>

#include "lattice_mesh.h"

namespace particle_surface_tracker {

/// The edge of a lattice line on which a triangle crosses the line, and where on it.
struct LineCrossing {
  std::int32_t edge;  ///< Number of its lower node along the line.
  double place;       ///< In [0, 1]; rounded, and the same wherever it is asked for.
};

/// Where a triangle crosses a lattice line, which is known to be somewhere from cell `lowest` to cell `highest` along
/// it.
/// \param line a node of the line.
/// \param facing sign of the normal's component along `axis`.
LineCrossing find_on_line(const LatticeMesh& mesh, std::uint32_t triangle, const openvdb::Coord& line, int axis,
                          int facing, std::int32_t lowest, std::int32_t highest);

}  // namespace particle_surface_tracker
