#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <openvdb/Types.h>

#include "particle_surface_tracker/core/mesh_twins.h"
#include "particle_surface_tracker/core/topology_cells.h"
#include "particle_surface_tracker/core/triangle_mesh.h"
#include "particle_surface_tracker/stages/mesh_lattice.h"

namespace particle_surface_tracker {

/// What re-meshing is told by the stages before it.
struct RemeshingRequest {
  /// Cells of Γ that are to be made anew (Sec. 5.3), in any order.
  std::vector<openvdb::Coord> flagged_cells;
  /// Nodes where topology matching (Sec. 6) has given Γ a new value; sorted, unique. Elsewhere Γ is the mesh's own.
  std::vector<openvdb::Coord> nodes;
  /// Γ at them [m], negative inside.
  std::vector<float> gamma;
  /// True where φ < 0 at a node of Γ. Asked around components that cross no lattice edge; without it, nothing speaks
  /// for liquid there.
  std::function<bool(const openvdb::Coord&)> is_liquid;
  /// Cells in which triangles cross each other count as tangles, also where Γ does not see it.
  bool remesh_crossings = false;
};

/// What re-meshing did to a mesh.
struct RemeshingReport {
  std::size_t flagged_cells = 0;       ///< As requested, each counted once.
  std::size_t changed_nodes = 0;       ///< Nodes of the request with another sign than the mesh's.
  std::size_t complex_cells = 0;       ///< With an edge that is crossed twice or more, or around a node that the mesh
                                       ///< winds around neither 0 times nor once.
  std::size_t tangled_cells = 0;       ///< Of these, the ones made anew: sheets overlap in them.
  std::size_t deep_cells = 0;          ///< Made anew because no sign changes around the mesh in them.
  std::size_t marked_by_growth = 0;    ///< Made anew so that the front is simple.
  std::size_t remeshed_cells = 0;      ///< All cells that were made anew.
  std::size_t removed_components = 0;  ///< Too small to cross a lattice edge, and not what φ says there.
  std::size_t kept_components = 0;     ///< Too small to cross a lattice edge, and as φ says.
  std::size_t removed_triangles = 0;
  std::size_t new_triangles = 0;
  std::size_t new_vertices = 0;  ///< They are the last ones of the mesh. δ is interpolated and to be measured anew.
  std::size_t retries = 0;       ///< How often the marked region had to grow because it could not be cut or filled.
  std::size_t fallbacks = 0;     ///< Of these, how often a whole component, or everything, was made anew.
  bool gave_up = false;          ///< Nothing led to a sound mesh: it was left as it is.

  bool changed() const { return removed_triangles + new_triangles > 0; }
};

/// Makes the surface anew in the cells of Γ where its topology changes (Sec. 7): flagged cells, cells at nodes whose
/// sign changed, cells where sheets overlap, and cells whose surface Γ cannot see (the deep cell test). The mesh is cut
/// along the outside of these cells and filled by the surface Γ = 0; everything else keeps its bits, order and ids, and
/// a mesh without such cells is not touched. The result is closed, manifold and consistently oriented if the mesh is.
///
/// Components that cross no edge of the lattice are removed unless φ confirms them. A mesh may end up empty.
/// \param lattice of this very mesh.
/// \param twins of the mesh, as far as known (UpkeepMemory); kept in step.
/// \param record receives the cells of each kind, and the changed nodes; null: nothing is recorded.
/// \return what was done; if `gave_up`, the mesh is unchanged.
/// \throw MeshError if the numbers of nodes and values in the request differ, or the lattice is that of another mesh.
RemeshingReport remesh(TriangleMesh& mesh, const MeshLattice& lattice, const RemeshingRequest& request,
                       MeshTwins& twins, TopologyCells* record = nullptr);
RemeshingReport remesh(TriangleMesh& mesh, const MeshLattice& lattice, const RemeshingRequest& request,
                       TopologyCells* record = nullptr);

}  // namespace particle_surface_tracker
