#pragma once

#include <cstdint>
#include <vector>

#include "particle_surface_tracker/stages/mesh_lattice.h"

#include "lattice_mesh.h"
#include "triangle_slicer.h"

namespace particle_surface_tracker {

/// Finds the crossings of triangles and lattice edges. Keeps its memory from one triangle to the next.
class CrossingFinder {
 public:
  explicit CrossingFinder(const LatticeMesh& mesh) : mesh_(mesh), slicer_(mesh) {}

  /// Appends those of a triangle: line by line where the triangle is near few of them, else along its cuts.
  void append_crossings(std::uint32_t triangle, std::vector<EdgeCrossing>& crossings);

 private:
  struct Box {
    openvdb::Coord lower;  // cells
    openvdb::Coord upper;

    std::int64_t planes(int axis) const { return std::int64_t{upper[axis]} - lower[axis]; }
  };

  void test_lines(std::uint32_t triangle, const Box& box, int axis, std::vector<EdgeCrossing>& crossings) const;

  const LatticeMesh& mesh_;
  TriangleSlicer slicer_;
};

}  // namespace particle_surface_tracker
