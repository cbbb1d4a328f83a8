#include "particle_surface_tracker/io/mesh_reader.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "mesh_soup.h"
#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/mesh_validation.h"

namespace particle_surface_tracker {
namespace {

TriangleMesh to_mesh(const MeshSoup& soup, std::vector<Triangle> triangles) {
  TriangleMesh mesh(soup.positions, std::move(triangles));
  const auto add = [&mesh](const char* name, const auto& values, const std::vector<float>& initial_value) {
    if (values.empty()) return;
    const std::size_t index = mesh.attributes().add(name, initial_value.size(), initial_value);
    float* out = mesh.attributes()[index].values.data();
    for (const auto& value : values) out = std::copy(value.begin(), value.end(), out);
  };
  add(TriangleMesh::color_name, soup.colors, {1.0F, 1.0F, 1.0F, 1.0F});
  add(TriangleMesh::texcoord_name, soup.texcoords, {0.0F, 0.0F});
  return mesh;
}

/// Turns polygons into a mesh without degenerate triangles and unused vertices.
TriangleMesh clean_mesh(const MeshSoup& soup, std::vector<std::string>& warnings) {
  std::vector<Triangle> triangles = triangulate(soup);
  const auto is_degenerate = [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; };
  const auto end = std::remove_if(triangles.begin(), triangles.end(), is_degenerate);
  if (end != triangles.end()) {
    warnings.push_back(fmt::format("dropped {} degenerate triangles", triangles.end() - end));
    triangles.erase(end, triangles.end());
  }
  if (triangles.empty()) throw InputError("it holds no triangles");
  TriangleMesh mesh = to_mesh(soup, std::move(triangles));
  mesh.remove_unused_vertices();
  if (const std::size_t unused = soup.positions.size() - mesh.vertex_count(); unused > 0) {
    warnings.push_back(fmt::format("dropped {} vertices that no triangle uses", unused));
  }
  return mesh;
}

void warn_of_seams(std::size_t seams, std::vector<std::string>& warnings) {
  if (seams == 0) return;
  warnings.push_back(fmt::format(
      "{} vertices on texture seams keep the first of their texture coordinates: a vertex carries only one", seams));
}

LoadedMesh build(MeshSoup soup) {
  LoadedMesh loaded;
  warn_of_seams(move_texcoords_to_vertices(soup), loaded.warnings);
  std::vector<std::string> warnings;
  loaded.mesh = clean_mesh(soup, warnings);

  // Two parts of a good mesh may touch in a point and must stay two; so equal positions are merged only where the mesh
  // is not closed without that.
  if (!describe_mesh_defects(loaded.mesh.positions(), loaded.mesh.triangles()).empty()) {
    std::size_t seams = 0;
    const std::size_t vertex_count = soup.positions.size();
    if (const std::size_t merged = merge_equal_positions(soup, seams); merged > 0) {
      warnings = {fmt::format("merged {} of {} vertices that the format had doubled", merged, vertex_count)};
      warn_of_seams(seams, warnings);
      loaded.mesh = clean_mesh(soup, warnings);
    }
  }
  loaded.warnings.insert(loaded.warnings.end(), warnings.begin(), warnings.end());
  return loaded;
}

}  // namespace

LoadedMesh read_initial_mesh(const std::string& path) {
  MeshSoup soup = read_mesh_soup(path);
  LoadedMesh loaded;
  try {
    loaded = build(std::move(soup));
  } catch (const InputError& error) {
    throw InputError(fmt::format("Cannot read the mesh '{}': {}.", path, error.what()));
  }
  try {
    check_closed_manifold(loaded.mesh);
  } catch (const MeshError& error) {
    throw MeshError(fmt::format("'{}': {}", path, error.what()));
  }
  for (std::string& line : orient_outward(loaded.mesh)) loaded.warnings.push_back(std::move(line));
  return loaded;
}

}  // namespace particle_surface_tracker
