#include "particle_surface_tracker/stages/mesh_query.h"

#include "line_signs.h"

namespace particle_surface_tracker {

MeshQuery::MeshQuery(const MeshLattice& lattice) : lattice_(lattice) {}

MeshQuery::~MeshQuery() = default;

const LineSigns& MeshQuery::signs() const {
  if (!signs_) signs_ = std::make_unique<LineSigns>(make_mesh_signs(lattice_));
  return *signs_;
}

}  // namespace particle_surface_tracker
