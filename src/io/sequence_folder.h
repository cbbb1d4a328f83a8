#pragma once

#include <cstdint>
#include <string>

namespace particle_surface_tracker {

/// Makes the folder of a sequence of files, and its parents, where they are missing, and tries whether files can be
/// written there.
/// \throw OutputError if that fails.
void make_sequence_folder(const std::string& folder);

/// Path of the file of one frame: `frame_000042.` and the extension.
std::string frame_file(const std::string& folder, std::uint64_t frame, const char* extension);

}  // namespace particle_surface_tracker
