#include "ros/live/save_path.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

namespace fs = std::filesystem;

fs::path real_folder(const std::string& folder) {
  if (folder.empty()) {
    throw ParameterError("~save_folder is not set; set it to the folder that files may be written to");
  }
  if (!fs::path(folder).is_absolute()) {
    throw ParameterError(fmt::format("~save_folder is '{}'; it must be an absolute path", folder));
  }
  std::error_code error;
  fs::path real = fs::canonical(folder, error);
  if (error || !fs::is_directory(real, error)) {
    throw ParameterError(fmt::format("~save_folder is '{}', which is no folder", folder));
  }
  return real;
}

bool is_below(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

/// Where a file lies once all links are followed, as far as its folders exist.
fs::path real_path(const fs::path& folder, const std::string& name) {
  if (name.empty()) throw ParameterError("the path is empty; it must name a file below ~save_folder");
  if (name.find('\0') != std::string::npos) throw ParameterError("the path holds a zero byte");
  const fs::path wanted(name);
  std::error_code error;
  fs::path real = fs::weakly_canonical(folder / wanted, error);
  if (error) throw ParameterError(fmt::format("the path '{}' cannot be resolved: {}", name, error.message()));
  if (wanted.is_absolute() || !is_below(real, folder) || real == folder) {
    throw ParameterError(
        fmt::format("the path '{}' is not below ~save_folder '{}'; it must be relative to it", name, folder.string()));
  }
  return real;
}

}  // namespace

std::string path_below(const std::string& folder, const std::string& name, const std::vector<std::string>& endings) {
  const fs::path path = real_path(real_folder(folder), name);
  const std::string extension = path.extension().string();
  if (std::find(endings.begin(), endings.end(), extension) == endings.end()) {
    throw ParameterError(
        fmt::format("the path '{}' ends in '{}'; it must end in {}", name, extension, fmt::join(endings, " or ")));
  }
  return path.string();
}

void make_folders_of(const std::string& path) {
  const fs::path folder = fs::path(path).parent_path();
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw OutputError(fmt::format("Cannot make the folder '{}': {}.", folder.string(), error.message()));
}

}  // namespace particle_surface_tracker
