#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace particle_surface_tracker {

/// Makes the folder of a sequence of files, and its parents, where they are missing, and tries whether files can be
/// written there.
/// \throw OutputError if that fails.
void make_sequence_folder(const std::string& folder);

/// Path of the file of one frame: `frame_000042.` and the extension.
std::string frame_file(const std::string& folder, std::uint64_t frame, const char* extension);

/// Names of all files in the folder that are called like those of frame_file(). None if it cannot be read.
std::vector<std::string> frame_files(const std::string& folder, const char* extension);

}  // namespace particle_surface_tracker
