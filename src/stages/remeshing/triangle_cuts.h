#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>

#include "particle_surface_tracker/stages/mesh_lattice.h"

namespace particle_surface_tracker::remeshing {

/// The cuts of the triangles that have been asked for, each made once.
class TriangleCuts {
 public:
  explicit TriangleCuts(const MeshLattice& lattice) : lattice_(lattice) {}

  const MeshLattice& lattice() const { return lattice_; }

  /// Valid as long as this object.
  const TriangleCut& of(std::uint32_t triangle) {
    std::unique_ptr<TriangleCut>& cut = cuts_[triangle];
    if (cut == nullptr) cut = std::make_unique<TriangleCut>(lattice_.cut_triangle(triangle));
    return *cut;
  }

  /// True if a piece of the triangle lies in the cell.
  bool meets(std::uint32_t triangle, const openvdb::Coord& cell) {
    const TriangleCut& cut = of(triangle);
    for (const openvdb::Coord& corner : cut.cells) {
      if (corner == cell) return true;
    }
    for (const TriangleCut::Segment& segment : cut.segments) {
      if (segment.face.upper_cell() == cell || segment.face.lower_cell() == cell) return true;
    }
    return false;
  }

 private:
  const MeshLattice& lattice_;
  std::unordered_map<std::uint32_t, std::unique_ptr<TriangleCut>> cuts_;
};

}  // namespace particle_surface_tracker::remeshing
