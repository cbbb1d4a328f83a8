#pragma once

#include <string>
#include <string_view>

namespace particle_surface_tracker {

/// The whole content of a file.
/// \throw InputError that names the path and why it cannot be read.
std::string read_file(const std::string& path);

/// Writes a file so that it appears whole under its name or not at all: into a temporary file beside it, which is
/// renamed at the end. A file of that name is replaced; anything else of that name (a folder, a device) is an error.
/// \throw OutputError that names the path and the reason; the temporary file is removed then.
void write_file_whole(const std::string& path, std::string_view bytes);

/// As write_file_whole(), and flushed to the disk, file and name, before it returns: after a power failure the file is
/// the new or the old one, and whole.
/// \throw OutputError as write_file_whole().
void write_file_durably(const std::string& path, std::string_view bytes);

}  // namespace particle_surface_tracker
