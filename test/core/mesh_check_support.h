#pragma once

#include <map>
#include <string>
#include <vector>

#include "particle_surface_tracker/core/mesh_check.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test {

using Triangles = std::vector<Triangle>;

/// The kinds of defects that occur, with their counts.
inline std::map<std::string, std::size_t> counts_of(const MeshCheck& check) {
  std::map<std::string, std::size_t> counts;
  for (const NamedMeshDefect& kind : list_defects(check)) {
    if (kind.defect->count > 0) counts[kind.name] = kind.defect->count;
  }
  return counts;
}

inline MeshCheck check_of(const TriangleMesh& mesh) {
  return check_mesh(mesh.positions(), mesh.triangles());
}

inline MeshCheck welded_check_of(const TriangleMesh& mesh) {
  MeshCheckOptions options;
  options.unused_vertices = false;
  return check_mesh(mesh.positions(), weld_by_position(mesh.positions(), mesh.triangles()).triangles, options);
}

inline TriangleMesh unit_box() {
  return make_box({0, 0, 0}, {1, 1, 1});
}

inline TriangleMesh box(double center, double half_side) {
  return make_box(Vec3d::Constant(center - half_side), Vec3d::Constant(center + half_side));
}

/// A tetrahedron of the corner `a` and three others, outward.
inline const Triangles kTetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

}  // namespace particle_surface_tracker::test
