#pragma once

#include <string>
#include <vector>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// A mesh as its file has it, whatever its state.
struct RawMesh {
  std::vector<Vec3f> positions;
  std::vector<Triangle> triangles;  ///< May name vertices that are not there, or one of them twice.
  bool has_indices = true;          ///< False where the format (STL) gives every triangle vertices of its own.
};

/// Reads a mesh for judging it: the same formats as read_initial_mesh(), but nothing is repaired, turned, merged or
/// refused. Faces of more than three corners are cut into triangles; those of one or two become degenerate triangles,
/// which repeat the last corner.
/// \throw InputError if the file is missing, unreadable or damaged.
RawMesh read_raw_mesh(const std::string& path);

}  // namespace particle_surface_tracker
