#pragma once

#include <string>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// Writes a mesh for ParaView: VTK's XML format of surfaces (.vtp), with delta, id, colour (four bytes) and every other
/// attribute as point data. As whole as write_ply().
/// \throw OutputError as write_ply().
void write_vtp(const std::string& path, const TriangleMesh& mesh);

}  // namespace particle_surface_tracker
