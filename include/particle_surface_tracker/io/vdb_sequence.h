#pragma once

#include <cstdint>
#include <string>

#include "particle_surface_tracker/core/implicit_surface.h"

namespace particle_surface_tracker {

/// Writes φ of a frame as OpenVDB file with one grid, `phi`: a level set [m], negative inside, whose active nodes are
/// those next to φ = 0. The same surface gives the same bytes. As whole as write_ply().
/// \throw OutputError as write_ply().
void write_vdb(const std::string& path, const ImplicitSurface& surface);

/// Writes φ of the frames of a sequence into one folder: `frame_000042.vdb`.
class VdbSequence {
 public:
  /// Makes the folder, as MeshSequence.
  /// \throw OutputError if that fails.
  explicit VdbSequence(std::string folder);

  /// \throw OutputError as write_vdb().
  void write(const ImplicitSurface& surface, std::uint64_t frame) const;

 private:
  std::string folder_;
};

}  // namespace particle_surface_tracker
