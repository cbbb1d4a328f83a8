#pragma once

#include <cstdint>
#include <vector>

#include "cell_set.h"
#include "particle_surface_tracker/stages/mesh_lattice.h"

namespace particle_surface_tracker::remeshing {

/// What stays of a triangle when the marked cells are cut away, as closed loops with the kept side on the left. Their
/// vertices are numbered like the points of the triangle's cut, followed by the triangle's corners 0, 1, 2.
struct TriangleOutline {
  enum class Kind {
    kWhole,         ///< No part of it is in a marked cell.
    kGone,          ///< All of it is.
    kPart,          ///< The loops say what stays.
    kContradiction  ///< The cut does not describe a triangle.
  };

  struct Loop {
    std::vector<std::uint32_t> vertices;
    std::uint32_t piece = 0;  ///< Loops of one connected piece have the same number.
  };

  Kind kind = Kind::kWhole;
  std::vector<Loop> loops;
};

/// Finds out what stays of triangles, purely by the combinatorics of their cuts.
class OutlineTracer {
 public:
  OutlineTracer(const MeshLattice& lattice, const CellSet& marked) : lattice_(lattice), marked_(marked) {}

  TriangleOutline trace(std::uint32_t triangle, const TriangleCut& cut);

 private:
  /// One side of a segment, or a piece of the triangle's own edge; its cell is on the left.
  struct HalfEdge {
    std::uint32_t from, to;
    std::uint32_t cell;  // index into cells_
    std::uint32_t twin;  // or kNone
  };

  bool find_half_edges(const Triangle& triangle, const TriangleCut& cut);
  bool follow_edge(int corner, const Triangle& triangle, const TriangleCut& cut);
  std::vector<std::uint32_t> points_on_edge(std::uint32_t from, std::uint32_t to, const TriangleCut& cut) const;
  std::uint32_t add_cell(const openvdb::Coord& cell);
  void add(std::uint32_t from, std::uint32_t to, std::uint32_t cell, std::uint32_t twin);
  std::uint32_t leaving(std::uint32_t vertex, std::uint32_t cell) const;
  std::uint32_t next_on_outline(std::uint32_t half_edge) const;
  bool is_outline(const HalfEdge& e) const;
  bool follow_outlines(const TriangleCut& cut, TriangleOutline& outline) const;
  std::vector<std::uint32_t> find_pieces() const;

  const MeshLattice& lattice_;
  const CellSet& marked_;
  std::vector<openvdb::Coord> cells_;  // that the triangle meets
  std::vector<char> is_marked_;        // per cell
  std::vector<HalfEdge> half_edges_;
  std::vector<std::vector<std::uint32_t>> leaving_;  // half-edges by the vertex that they begin at
};

}  // namespace particle_surface_tracker::remeshing
