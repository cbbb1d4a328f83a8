#include "sequence_folder.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <regex>
#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

// Asking for permissions is not enough: file systems may be read-only or full, and root may do anything.
void try_writing(const std::filesystem::path& folder) {
  const std::filesystem::path probe = folder / ".write_test";
  std::ofstream file(probe);
  file << "x" << std::flush;
  const bool written = static_cast<bool>(file);
  const int reason = errno;
  file.close();
  std::error_code ignored;
  std::filesystem::remove(probe, ignored);
  if (!written)
    throw OutputError(fmt::format("cannot write in folder '{}': {}", folder.string(), std::strerror(reason)));
}

}  // namespace

void make_sequence_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw OutputError(fmt::format("cannot make folder '{}': {}", folder, error.message()));
  try_writing(folder);
}

std::string frame_file(const std::string& folder, std::uint64_t frame, const char* extension) {
  return (std::filesystem::path(folder) / fmt::format("frame_{:06}.{}", frame, extension)).string();
}

std::vector<std::string> frame_files(const std::string& folder, const char* extension) {
  const std::regex pattern(fmt::format("frame_[0-9]{{6,}}\\.{}", extension));
  std::vector<std::string> names;
  std::error_code ignored;
  for (std::filesystem::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored)) {
    std::string name = entry->path().filename().string();
    if (std::regex_match(name, pattern)) names.push_back(std::move(name));
  }
  return names;
}

}  // namespace particle_surface_tracker
