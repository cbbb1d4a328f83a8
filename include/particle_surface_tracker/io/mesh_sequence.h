#pragma once

#include <cstdint>
#include <string>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

enum class MeshFormat { kPly, kObj, kVtp, kGlb };

/// Writes the meshes of a sequence into one folder, one file per frame: `frame_000042.ply`.
class MeshSequence {
 public:
  /// Makes the folder, and its parents, where they are missing, and tries whether files can be written there.
  /// \throw OutputError if that fails.
  MeshSequence(std::string folder, MeshFormat format);

  /// Path of the file of a frame.
  std::string path(std::uint64_t frame) const;

  /// \throw OutputError as write_ply(), write_obj(), write_vtp() and write_glb().
  void write(const TriangleMesh& mesh, std::uint64_t frame) const;

 private:
  std::string folder_;
  MeshFormat format_;
};

}  // namespace particle_surface_tracker
