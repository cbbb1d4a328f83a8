#pragma once

#include <string>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// Writes a mesh as binary glTF 2.0 (.glb): positions, normals, and colours and texture coordinates where present. What
/// glTF has no place for, delta and ids, is left out; vertices alike in all that is written become one.
/// \throw OutputError as write_ply().
void write_glb(const std::string& path, const TriangleMesh& mesh);

}  // namespace particle_surface_tracker
