#include <cctype>
#include <filesystem>

#include <fmt/format.h>

#include "file_bytes.h"
#include "mesh_soup.h"
#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

std::string lower_case_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension.empty() ? extension : extension.substr(1);
}

bool begins_with(const std::string& content, const char* mark) {
  return content.rfind(mark, 0) == 0;
}

/// Whether the first word is OFF, COFF, STCNOFF, …
bool begins_like_off(const std::string& content) {
  const std::size_t end = content.find_first_of(" \t\r\n");
  return end != std::string::npos && end >= 3 && end <= 7 && content.compare(end - 3, 3, "OFF") == 0;
}

/// The content decides where it can, the extension where it cannot.
MeshSoup parse(const std::string& content, const std::string& extension) {
  if (content.empty()) throw InputError("it is empty");
  if (begins_with(content, "ply\n") || begins_with(content, "ply\r")) return parse_ply(content);
  if (begins_like_off(content)) return parse_off(content);
  if (extension == "obj") return parse_obj(content);
  if (extension == "stl" || begins_with(content, "solid ")) {
    MeshSoup soup = parse_with_assimp(content, "stl");
    soup.has_indices = false;
    return soup;
  }
  throw InputError("it is not PLY, OFF, OBJ or STL, or its content does not belong to its extension");
}

}  // namespace

MeshSoup read_mesh_soup(const std::string& path) {
  const std::string content = read_file(path);
  try {
    return parse(content, lower_case_extension(path));
  } catch (const InputError& error) {
    throw InputError(fmt::format("Cannot read the mesh '{}': {}.", path, error.what()));
  }
}

}  // namespace particle_surface_tracker
