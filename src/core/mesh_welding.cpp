#include "equal_positions.h"
#include "particle_surface_tracker/core/mesh_check.h"

namespace particle_surface_tracker {

WeldedTriangles weld_by_position(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
  const std::vector<std::uint32_t> first = first_of_same_position(positions);
  WeldedTriangles welded;
  welded.triangles = triangles;
  for (Triangle& t : welded.triangles) {
    for (std::uint32_t& v : t) v = v < first.size() ? first[v] : v;
  }
  for (std::uint32_t v = 0; v < first.size(); ++v) welded.merged_vertices += first[v] != v;
  return welded;
}

}  // namespace particle_surface_tracker
