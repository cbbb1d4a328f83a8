#include "particle_surface_tracker/io/raw_mesh_reader.h"

#include <algorithm>
#include <utility>

#include "mesh_soup.h"

namespace particle_surface_tracker {
namespace {

/// The faces that triangulate() drops.
void append_small_faces(const MeshSoup& soup, std::vector<Triangle>& triangles) {
  std::size_t begin = 0;
  for (const std::size_t end : soup.polygon_ends) {
    if (end - begin == 1 || end - begin == 2) {
      triangles.push_back({soup.corners[begin], soup.corners[end - 1], soup.corners[end - 1]});
    }
    begin = end;
  }
}

bool names_missing_vertices(const MeshSoup& soup) {
  return std::any_of(soup.corners.begin(), soup.corners.end(),
                     [&](std::uint32_t corner) { return corner >= soup.positions.size(); });
}

/// Fans from the first corners: which corner is best cannot be said where some are missing.
std::vector<Triangle> fans_of(const MeshSoup& soup) {
  std::vector<Triangle> triangles;
  std::size_t begin = 0;
  for (const std::size_t end : soup.polygon_ends) {
    for (std::size_t k = begin + 1; k + 1 < end; ++k) {
      triangles.push_back({soup.corners[begin], soup.corners[k], soup.corners[k + 1]});
    }
    begin = end;
  }
  return triangles;
}

}  // namespace

RawMesh read_raw_mesh(const std::string& path) {
  MeshSoup soup = read_mesh_soup(path);
  RawMesh mesh;
  mesh.triangles = names_missing_vertices(soup) ? fans_of(soup) : triangulate(soup);
  append_small_faces(soup, mesh.triangles);
  mesh.has_indices = soup.has_indices;
  mesh.positions = std::move(soup.positions);
  return mesh;
}

}  // namespace particle_surface_tracker
