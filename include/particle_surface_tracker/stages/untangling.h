#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/triangle_mesh.h"
#include "particle_surface_tracker/stages/upkeep.h"

namespace particle_surface_tracker {

/// What untangle() did.
struct UntanglingReport {
  std::size_t tangles = 0;           ///< Places where triangles crossed near a fold.
  std::size_t untangled = 0;         ///< Those of them where none does any more.
  std::vector<std::uint32_t> moved;  ///< Vertices with a new position: increasing indices. Their δ must be measured.
};

/// Relaxes the vertices of triangles that cross each other next to an edge that has folded since its birth, until they
/// do not. Where surface is squeezed, as in a crease that closes, a few small triangles at a time run into each other;
/// Γ cannot see that (Sec. 7 of the paper re-meshes what crosses a lattice edge too often), and collapsing or
/// re-meshing them would cost more vertices than it costs to move these by less than their edges' length.
///
/// Connectivity, ids and order stay. Folds and tangles that a mesh was born with are left alone, so a mesh at rest
/// keeps every bit. What a relaxation of two rings cannot mend stays as it is.
/// \param mesh closed and manifold; its vertices' birth has been noted where there is something to compare with
/// (note_birth()), others have no fold at birth.
/// \throw MeshError if the mesh is not closed, oriented and manifold.
UntanglingReport untangle(TriangleMesh& mesh, UpkeepMemory& memory);

}  // namespace particle_surface_tracker
