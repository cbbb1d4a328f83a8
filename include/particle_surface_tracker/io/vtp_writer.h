#pragma once

#include <string>
#include <vector>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// Writes a mesh for ParaView: VTK's XML format of surfaces (.vtp), with delta, id, colour (four bytes) and every other
/// attribute as point data. As whole as write_ply().
/// \throw OutputError as write_ply().
void write_vtp(const std::string& path, const TriangleMesh& mesh);

/// One file of a time series.
struct TimedFile {
  std::string time;  ///< [s], as text, because a double does not hold all digits of a stamp.
  std::string name;  ///< Relative to the folder of the series.
};

/// Writes the list of a time series (.pvd), by which ParaView knows when each mesh is. As whole as write_ply().
/// \throw OutputError as write_ply().
void write_pvd(const std::string& path, const std::vector<TimedFile>& files);

}  // namespace particle_surface_tracker
