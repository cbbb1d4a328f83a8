#pragma once

#include <string>
#include <vector>

namespace particle_surface_tracker {

/// The whole path of a file in a folder, by a name that may come from anywhere on the network.
/// \param folder of the files; relative paths are refused, since nobody knows where a node was started.
/// \param name path below the folder.
/// \param endings that the name may have, with their dots.
/// \throw ParameterError if the folder is not set, relative or missing, or the name is empty, leads out of the folder
/// (also by a link), or has no such ending.
std::string path_below(const std::string& folder, const std::string& name, const std::vector<std::string>& endings);

/// Makes the folders that a file shall lie in.
/// \throw OutputError if one cannot be made.
void make_folders_of(const std::string& path);

}  // namespace particle_surface_tracker
