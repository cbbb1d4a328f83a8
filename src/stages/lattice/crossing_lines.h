#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "particle_surface_tracker/stages/mesh_lattice.h"

#include "lattice_mesh.h"

namespace particle_surface_tracker {

/// All crossings of a mesh with the edges of the lattice, line by line.
class CrossingLines {
 public:
  explicit CrossingLines(const LatticeMesh& mesh);

  const std::vector<EdgeCrossing>& crossings() const { return crossings_; }

  ArrayRange<EdgeCrossing> on_edge(const LatticeEdge& edge) const;

  /// Sum of the steps on the line along an axis through a node, up to the node.
  int winding_number(const openvdb::Coord& node, int axis) const;

 private:
  /// The lattice line along an axis at (first, second) along the next axis and the one after it.
  struct Line {
    std::int32_t first;
    std::int32_t second;
    std::size_t begin;
    std::size_t end;
  };

  void find(const LatticeMesh& mesh);
  void order_edges(const LatticeMesh& mesh);
  void index_lines();
  ArrayRange<EdgeCrossing> line_through(const openvdb::Coord& node, int axis) const;

  std::vector<EdgeCrossing> crossings_;
  std::vector<std::int32_t> windings_;      // beyond each crossing
  std::array<std::vector<Line>, 3> lines_;  // per axis, sorted
};

}  // namespace particle_surface_tracker
