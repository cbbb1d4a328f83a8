#pragma once

#include <memory>

#include "particle_surface_tracker/stages/mesh_lattice.h"

namespace particle_surface_tracker {

class LineSigns;

/// What is compared with an IsosurfaceQuery: a mesh, by its lattice, and which nodes of Γ are inside it. These are
/// worked out when they are first asked for, and then serve all that look at this mesh. Not to be shared by threads.
class MeshQuery {
 public:
  /// \param lattice of the mesh; must live as long as this.
  explicit MeshQuery(const MeshLattice& lattice);
  ~MeshQuery();
  MeshQuery(const MeshQuery&) = delete;
  MeshQuery& operator=(const MeshQuery&) = delete;

  const MeshLattice& lattice() const { return lattice_; }
  const LineSigns& signs() const;

 private:
  const MeshLattice& lattice_;
  mutable std::unique_ptr<LineSigns> signs_;
};

}  // namespace particle_surface_tracker
