#include "vertex_ids.h"

#include <algorithm>

namespace particle_surface_tracker {

std::vector<std::uint32_t> ids_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& vertices) {
  std::vector<std::uint32_t> ids;
  ids.reserve(vertices.size());
  for (const std::uint32_t v : vertices) ids.push_back(mesh.ids()[v]);
  return ids;
}

std::vector<std::uint32_t> vertices_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& ids) {
  std::vector<std::uint32_t> vertices;
  for (const std::uint32_t id : ids) {
    const auto found = std::lower_bound(mesh.ids().begin(), mesh.ids().end(), id);
    if (found == mesh.ids().end() || *found != id) continue;
    vertices.push_back(static_cast<std::uint32_t>(found - mesh.ids().begin()));
  }
  return vertices;
}

}  // namespace particle_surface_tracker
