#pragma once

#include <array>

#include <openvdb/Types.h>

#include "particle_surface_tracker/stages/mesh_lattice.h"
#include "stages/triangulation/cell_loops.h"

namespace particle_surface_tracker::remeshing {

/// A node moved along an axis.
inline openvdb::Coord moved(openvdb::Coord node, int axis, int steps) {
  node[axis] += steps;
  return node;
}

/// Corner of a cell, numbered as in cell_loops.h.
inline openvdb::Coord corner_of(const openvdb::Coord& cell, int corner) {
  return cell.offsetBy(corner & 1, corner >> 1 & 1, corner >> 2);
}

/// Edge of a cell, numbered as in cell_loops.h.
inline LatticeEdge edge_of(const openvdb::Coord& cell, int edge) {
  const CellEdge& e = cell_edges()[edge];
  return {corner_of(cell, e.lower), e.axis};
}

/// Face of a cell, numbered as in cell_loops.h.
inline LatticeFace face_of(const openvdb::Coord& cell, int face) {
  return {moved(cell, face / 2, face % 2), static_cast<std::uint8_t>(face / 2)};
}

/// The cell beyond a face of a cell.
inline openvdb::Coord cell_beyond(const openvdb::Coord& cell, int face) {
  return moved(cell, face / 2, face % 2 == 1 ? 1 : -1);
}

/// The four cells around an edge.
inline std::array<openvdb::Coord, 4> cells_around(const LatticeEdge& edge) {
  const int u = (edge.axis + 1) % 3;
  const int v = (edge.axis + 2) % 3;
  const openvdb::Coord before = moved(edge.node, u, -1);
  return {edge.node, before, moved(edge.node, v, -1), moved(before, v, -1)};
}

/// The four edges of a face.
inline std::array<LatticeEdge, 4> edges_around(const LatticeFace& face) {
  const auto u = static_cast<std::uint8_t>((face.axis + 1) % 3);
  const auto v = static_cast<std::uint8_t>((face.axis + 2) % 3);
  return {{{face.node, u}, {face.node, v}, {moved(face.node, v, 1), u}, {moved(face.node, u, 1), v}}};
}

}  // namespace particle_surface_tracker::remeshing
