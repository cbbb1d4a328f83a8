#include "particle_surface_tracker/core/vertex_components.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace particle_surface_tracker {
namespace {

/// Root of the tree of `vertex`; every node passed on the way is hung one step higher.
std::uint32_t find_root(std::vector<std::uint32_t>& parents, std::uint32_t vertex) {
  while (parents[vertex] != vertex) {
    parents[vertex] = parents[parents[vertex]];
    vertex = parents[vertex];
  }
  return vertex;
}

/// A forest over the vertices with one tree for each component. Parents are never above their children, so the root of
/// a tree is its lowest vertex.
struct Forest {
  std::vector<std::uint32_t> parents;
  std::size_t trees = 0;
};

/// Joins the trees of a root and another vertex.
/// \return the root of both.
std::uint32_t join(Forest& forest, std::uint32_t root, std::uint32_t vertex) {
  const std::uint32_t other_root = find_root(forest.parents, vertex);
  if (other_root == root) return root;
  --forest.trees;
  const auto [low, high] = std::minmax(root, other_root);
  forest.parents[high] = low;
  return low;
}

Forest connect(std::size_t vertex_count, const std::vector<Triangle>& triangles) {
  Forest forest;
  forest.trees = vertex_count;
  forest.parents.resize(vertex_count);
  std::iota(forest.parents.begin(), forest.parents.end(), 0U);
  const std::vector<std::uint32_t>& parents = forest.parents;
  for (const auto& [a, b, c] : triangles) {
    if (parents[a] == parents[b] && parents[a] == parents[c]) continue;
    join(forest, join(forest, find_root(forest.parents, a), b), c);
  }
  return forest;
}

}  // namespace

VertexComponents vertex_components(std::size_t vertex_count, const std::vector<Triangle>& triangles) {
  Forest forest = connect(vertex_count, triangles);
  // A parent comes before its children, so it has its label when they ask for it.
  std::vector<std::uint32_t>& labels = forest.parents;
  std::uint32_t next_label = 0;
  for (std::uint32_t vertex = 0; vertex < vertex_count; ++vertex) {
    labels[vertex] = labels[vertex] == vertex ? next_label++ : labels[labels[vertex]];
  }
  return {std::move(forest.parents), forest.trees};
}

}  // namespace particle_surface_tracker
