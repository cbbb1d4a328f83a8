#pragma once

#include <optional>
#include <string>

#include "particle_surface_tracker/core/mesh_check.h"

namespace particle_surface_tracker {

/// What was found in a mesh file.
struct FileCheck {
  std::string path;
  bool has_indices = true;  ///< False: the format has none, and vertices were joined by position before the check.
  MeshCheck mesh;
  std::size_t merged_vertices = 0;  ///< That have the position of another one.
  std::optional<MeshCheck> welded;  ///< With those joined; none if there are none.
};

/// \throw InputError if the file cannot be read.
FileCheck check_file(const std::string& path);

/// Whether the file holds a mesh, and nothing is wrong with it, joined or not, but up to a share of self-intersecting
/// triangles.
bool is_sound(const FileCheck& check, double max_self_intersecting_share);

/// Text for people: a verdict, sizes, and every defect with its first places.
std::string to_text(const FileCheck& check, double max_self_intersecting_share);

/// A JSON object on one line.
std::string to_json(const FileCheck& check, double max_self_intersecting_share);

/// The JSON object of a file that cannot be read.
std::string error_to_json(const std::string& path, const std::string& error);

}  // namespace particle_surface_tracker
