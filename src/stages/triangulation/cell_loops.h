#pragma once

#include <array>
#include <cstdint>

namespace particle_surface_tracker {

// Numbering of the parts of a cubic lattice cell. Corner c is at the upper end along x, y, z where its bits 0, 1, 2 are
// set. Edges 4a .. 4a + 3 run along axis a; faces 2a and 2a + 1 are the lower and the upper one across axis a.
constexpr int kCellCorners = 8;
constexpr int kCellEdges = 12;
constexpr int kCellFaces = 6;

/// One edge of a cell: its axis and the corners at its ends.
struct CellEdge {
  std::uint8_t axis;
  std::uint8_t lower;
  std::uint8_t upper;
};

/// The twelve edges of a cell.
const std::array<CellEdge, kCellEdges>& cell_edges();

/// True if two edges of a cell belong to one face of it.
bool edges_share_face(int a, int b);

/// The isolines on one face of a cell: directed segments between its cut edges.
struct FaceSegments {
  struct Segment {
    std::uint8_t from;
    std::uint8_t to;
  };
  int count = 0;
  std::array<Segment, 2> segments{};
};

/// The segments on a face, for the 256 patterns of signs. Seen from outside the cell the inside corners are to the
/// right of each segment. Where all four edges are cut, the inside corners are kept apart. The cell on the other side
/// of the face gets the same segments, reversed.
/// \param inside bit c is set where corner c is inside.
FaceSegments face_segments(int face, unsigned inside);

/// The segments of all faces of a cell chained into closed loops that share no edge: the outlines of the surface in the
/// cell, counter-clockwise seen from the side that is outside.
struct CellLoops {
  int count = 0;                                ///< Number of loops.
  std::array<std::uint8_t, 5> begin{};          ///< Loop l has the points begin[l] .. begin[l + 1] − 1.
  std::array<std::uint8_t, kCellEdges> edge{};  ///< The cut edge that each point lies on; each cut edge occurs once.

  int size(int loop) const { return begin[loop + 1] - begin[loop]; }
};

/// The loops of each of the 256 patterns of signs, made once from the rule for faces.
const std::array<CellLoops, 256>& cell_loops();

}  // namespace particle_surface_tracker
