#pragma once

#include <cstdint>
#include <string>

#include "particle_surface_tracker/core/topology_cells.h"

namespace particle_surface_tracker {

/// Writes cells and nodes of Γ as OpenVDB file. Of each kind of cell a mask of its name (`flagged`, `complex`,
/// `tangled`, `deep`, `marked`, `front`), whose voxels lie around the middles of the cells; of the nodes, with voxels
/// around them, the mask `changed_nodes` and ψ [m] in the grids `psi_fixed` and `psi_unknown`. The same cells give the
/// same bytes. As whole as write_ply().
/// \throw OutputError as write_ply().
void write_cells_vdb(const std::string& path, const TopologyCells& cells);

/// Why a cell is where it is, or what a node is: `kind` in write_cells_vtp(). A cell is of the first kind that applies.
enum class CellKind : std::uint8_t {
  kFlagged = 1,  ///< Flagged at the start.
  kTangled,      ///< Marked because sheets overlap.
  kDeep,         ///< Marked because the mesh is thinner than Γ can see.
  kAtChange,     ///< Marked because a corner changed sides.
  kGrown,        ///< Marked so that the front is simple, or that the cells can be cut and filled.
  kComplex,      ///< Not marked: detail below the size of a cell, which is kept.
  kFixedNode,
  kUnknownNode
};

/// Writes them as points for ParaView (.vtp): the middles of the cells, then the fixed nodes and the unknowns. Point
/// data are `kind` (CellKind), a 0 or 1 for each kind of cell that write_cells_vdb() has, `changed_nodes` and `psi`
/// [m], which is 0 at cells. The same cells give the same bytes. As whole as write_ply().
/// \throw OutputError as write_ply().
void write_cells_vtp(const std::string& path, const TopologyCells& cells);

/// Writes the cells of single frames of a sequence into one folder: `cells_000042.vdb` and `cells_000042.vtp`.
class CellFiles {
 public:
  /// Makes the folder, as MeshSequence.
  /// \throw OutputError if that fails.
  explicit CellFiles(std::string folder);

  /// \throw OutputError as write_cells_vdb().
  void write(const TopologyCells& cells, std::uint64_t frame) const;

 private:
  std::string folder_;
};

}  // namespace particle_surface_tracker
