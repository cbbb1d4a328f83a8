#include "particle_surface_tracker/core/vertex_components.h"

#include "disjoint_sets.h"

namespace particle_surface_tracker {

VertexComponents vertex_components(std::size_t vertex_count, const std::vector<Triangle>& triangles) {
  DisjointSets vertices(vertex_count);
  for (const auto& [a, b, c] : triangles) {
    if (vertices.have_same_parent(a, b) && vertices.have_same_parent(a, c)) continue;
    vertices.join(vertices.join(a, b), c);
  }
  return {vertices.labels(), vertices.count()};
}

}  // namespace particle_surface_tracker
