#pragma once

#include <string>

#include <particle_surface_tracker/TrackedMesh.h>

namespace particle_surface_tracker {

/// Writes a mesh into a folder, by a name that may come from anywhere on the network. The file appears whole or not at
/// all; folders below the given one are made.
/// \param name path below the folder that ends in .ply or .obj.
/// \return the whole path of the file.
/// \throw ParameterError as path_below().
/// \throw OutputError if the file cannot be written.
std::string save_mesh(const std::string& folder, const std::string& name, const TrackedMesh& mesh);

}  // namespace particle_surface_tracker
