#pragma once

#include <cstdint>
#include <string>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// Writes Γ, the signed distance of a mesh at the nodes of its lattice (Sec. 6), as OpenVDB file with one grid,
/// `gamma`: a level set [m], negative inside, whose active nodes are those within three cells of the mesh. Distances
/// are exact up to rounding. The same mesh gives the same bytes. As whole as write_ply().
/// \param h cell size Δx_Γ [m].
/// \throw MeshError as check_closed_manifold() and MeshLattice.
/// \throw ParameterError as MeshLattice.
/// \throw OutputError as write_ply().
void write_gamma_vdb(const std::string& path, const TriangleMesh& mesh, double h);

/// Writes Γ of the frames of a sequence into one folder: `gamma_000042.vdb`, which may be the folder of φ.
class GammaSequence {
 public:
  /// Makes the folder, as MeshSequence.
  /// \param h cell size Δx_Γ [m].
  /// \throw OutputError if that fails.
  GammaSequence(std::string folder, double h);

  /// \throw MeshError, ParameterError, OutputError as write_gamma_vdb().
  void write(const TriangleMesh& mesh, std::uint64_t frame) const;

 private:
  std::string folder_;
  double h_;
};

}  // namespace particle_surface_tracker
