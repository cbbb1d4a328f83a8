#include "particle_surface_tracker/core/mesh_validation.h"

#include <algorithm>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/mesh_check.h"

namespace particle_surface_tracker {

std::string describe_mesh_defects(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
  if (triangles.empty()) return "it has no triangles";
  const MeshDefects defects = find_mesh_defects(positions, triangles);
  if (defects.dangling_triangles.count > 0) {
    const std::uint32_t first = defects.dangling_triangles.places.front().index;
    const std::uint32_t highest = *std::max_element(triangles[first].begin(), triangles[first].end());
    return fmt::format("triangle {} names vertex {}, but there are only {}", first, highest, positions.size());
  }
  return describe(list_defects(defects));
}

void check_closed_manifold(const TriangleMesh& mesh) {
  const std::string defects = describe_mesh_defects(mesh.positions(), mesh.triangles());
  if (!defects.empty()) throw MeshError("The mesh is not a closed oriented manifold: " + defects + ".");
}

}  // namespace particle_surface_tracker
