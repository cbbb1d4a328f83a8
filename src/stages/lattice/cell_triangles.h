#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <openvdb/Types.h>

#include "particle_surface_tracker/stages/mesh_lattice.h"

#include "lattice_mesh.h"
#include "stages/nodes/leaf_index.h"

namespace particle_surface_tracker {

/// The triangles of each cell: one array of triangles, sorted by blocks of 8³ cells, by cell and by triangle.
class CellTriangles {
 public:
  explicit CellTriangles(const LatticeMesh& mesh);

  /// Increasing indices of the triangles that meet a cell, and of small ones whose bounding box does.
  ArrayRange<std::uint32_t> in_cell(const openvdb::Coord& cell) const;

  /// Cells with triangles.
  std::vector<openvdb::Coord> cells() const;

 private:
  LeafIndex index_;
  std::vector<openvdb::Coord> leaves_;  // lowest cell of each
  std::vector<std::uint32_t> begin_;    // per leaf and cell of it
  std::vector<std::uint32_t> triangles_;
};

}  // namespace particle_surface_tracker
