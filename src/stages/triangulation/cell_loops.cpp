#include "cell_loops.h"

namespace particle_surface_tracker {

namespace {

std::array<CellEdge, kCellEdges> make_cell_edges() {
  std::array<CellEdge, kCellEdges> edges{};
  for (int axis = 0; axis < 3; ++axis) {
    for (int k = 0; k < 4; ++k) {
      const int lower = (k & 1) << ((axis + 1) % 3) | (k >> 1) << ((axis + 2) % 3);
      edges[4 * axis + k] = {static_cast<std::uint8_t>(axis), static_cast<std::uint8_t>(lower),
                             static_cast<std::uint8_t>(lower | 1 << axis)};
    }
  }
  return edges;
}

/// Corners of a face, counter-clockwise seen from outside the cell.
std::array<int, 4> face_corners(int face) {
  const int axis = face / 2;
  const int side = face % 2;
  const int u = 1 << ((axis + 1) % 3);
  const int v = 1 << ((axis + 2) % 3);
  const int base = side << axis;
  if (side == 1) return {base, base | u, base | u | v, base | v};
  return {base, base | v, base | u | v, base | u};
}

std::uint8_t edge_between(int a, int b) {
  const auto& edges = cell_edges();
  std::uint8_t e = 0;
  while ((1 << edges[e].lower | 1 << edges[e].upper) != (1 << a | 1 << b)) ++e;
  return e;
}

CellLoops chain_segments(unsigned inside) {
  constexpr std::uint8_t none = kCellEdges;
  std::array<std::uint8_t, kCellEdges> next;
  next.fill(none);
  for (int face = 0; face < kCellFaces; ++face) {
    const FaceSegments on_face = face_segments(face, inside);
    for (int s = 0; s < on_face.count; ++s) next[on_face.segments[s].from] = on_face.segments[s].to;
  }
  CellLoops loops;
  std::uint8_t points = 0;
  for (int start = 0; start < kCellEdges; ++start) {
    if (next[start] == none) continue;
    for (int e = start; next[e] != none;) {
      loops.edge[points++] = static_cast<std::uint8_t>(e);
      const int following = next[e];
      next[e] = none;
      e = following;
    }
    loops.begin[++loops.count] = points;
  }
  return loops;
}

std::array<CellLoops, 256> make_cell_loops() {
  std::array<CellLoops, 256> table;
  for (unsigned inside = 0; inside < 256; ++inside) table[inside] = chain_segments(inside);
  return table;
}

}  // namespace

const std::array<CellEdge, kCellEdges>& cell_edges() {
  static const std::array<CellEdge, kCellEdges> edges = make_cell_edges();
  return edges;
}

bool edges_share_face(int a, int b) {
  const CellEdge& first = cell_edges()[a];
  const CellEdge& second = cell_edges()[b];
  const int ones = first.lower & first.upper & second.lower & second.upper;
  const int zeros = ~(first.lower | first.upper | second.lower | second.upper) & 7;
  return (ones | zeros) != 0;
}

FaceSegments face_segments(int face, unsigned inside) {
  const std::array<int, 4> corners = face_corners(face);
  const auto is_inside = [&](int i) { return (inside >> corners[i % 4] & 1) != 0; };
  FaceSegments result;
  // Every run of inside corners is cut off by one segment: from the edge where it is entered to that where it is left.
  for (int first = 0; first < 4; ++first) {
    if (is_inside(first + 3) || !is_inside(first)) continue;
    int last = first;
    while (is_inside(last + 1)) ++last;
    result.segments[result.count++] = {edge_between(corners[(first + 3) % 4], corners[first]),
                                       edge_between(corners[last % 4], corners[(last + 1) % 4])};
  }
  return result;
}

const std::array<CellLoops, 256>& cell_loops() {
  static const std::array<CellLoops, 256> table = make_cell_loops();
  return table;
}

}  // namespace particle_surface_tracker
