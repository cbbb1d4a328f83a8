#include "front_growth.h"

#include "lattice_parts.h"

namespace particle_surface_tracker::remeshing {

void FrontGrowth::run() {
  for (; next_ < marked_.cells().size(); ++next_) {
    const openvdb::Coord cell = marked_.cells()[next_];
    for (int face = 0; face < kCellFaces; ++face) {
      const openvdb::Coord beyond = cell_beyond(cell, face);
      if (!marked_.contains(beyond)) look_at_front(beyond, face_of(cell, face));
    }
  }
}

void FrontGrowth::look_at_front(const openvdb::Coord& beyond, const LatticeFace& face) {
  if (tracer_.lattice().triangles_in_cell(beyond).empty()) return;
  for (const LatticeEdge& edge : edges_around(face)) {
    if (tracer_.lattice().crossings_on(edge).size() <= 1) continue;
    for (const openvdb::Coord& cell : cells_around(edge)) marked_.insert(cell);
  }
  if (!marked_.contains(beyond) && !tracer_.paths_on(face).simple) marked_.insert(beyond);
}

}  // namespace particle_surface_tracker::remeshing
