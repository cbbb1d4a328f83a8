#include "particle_surface_tracker/core/mesh_measures.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <tbb/parallel_for.h>
#include <Eigen/Geometry>

namespace particle_surface_tracker {
namespace {

/// Triangles summed by one task. It is fixed, so that the sums do not depend on the number of threads.
constexpr std::size_t kTrianglesPerChunk = 8192;

struct ChunkSums {
  double six_volumes = 0.0;
  double double_areas = 0.0;
  double smallest_squared_sine = 1.0;
};

/// Of the smallest angle of a triangle, which lies between its two longest edges: |ab × ac| is the product of their
/// lengths and this sine. Exact where it matters, for small angles, which a cosine does not tell from 0.
double squared_sine(const Vec3d& edge_ab, const Vec3d& edge_ac, const Vec3d& normal) {
  const double ab = edge_ab.squaredNorm(), ac = edge_ac.squaredNorm(), bc = (edge_ac - edge_ab).squaredNorm();
  const double longest = std::max({ab, ac, bc});
  const double middle = std::max(std::min(ab, ac), std::min(std::max(ab, ac), bc));
  return middle > 0.0 ? normal.squaredNorm() / middle / longest : 0.0;
}

ChunkSums sum_chunk(const std::vector<Vec3f>& positions, const Triangle* begin, const Triangle* end,
                    const Vec3d& origin) {
  ChunkSums sums;
  for (const Triangle* triangle = begin; triangle != end; ++triangle) {
    const Vec3d a = positions[(*triangle)[0]].cast<double>();
    const Vec3d edge_ab = positions[(*triangle)[1]].cast<double>() - a;
    const Vec3d edge_ac = positions[(*triangle)[2]].cast<double>() - a;
    const Vec3d normal = edge_ab.cross(edge_ac);
    sums.six_volumes += normal.dot(a - origin);
    sums.double_areas += normal.norm();
    sums.smallest_squared_sine = std::min(sums.smallest_squared_sine, squared_sine(edge_ab, edge_ac, normal));
  }
  return sums;
}

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

MeshMeasures measure_mesh(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
  MeshMeasures measures;
  if (triangles.empty()) return measures;

  // An origin on the mesh instead of far away keeps the terms of the volume small.
  const Vec3d origin = positions[triangles.front()[0]].cast<double>();
  const std::size_t chunk_count = (triangles.size() + kTrianglesPerChunk - 1) / kTrianglesPerChunk;
  std::vector<ChunkSums> sums(chunk_count);
  tbb::parallel_for(std::size_t{0}, chunk_count, [&](std::size_t chunk) {
    const std::size_t begin = chunk * kTrianglesPerChunk;
    const std::size_t end = std::min(begin + kTrianglesPerChunk, triangles.size());
    sums[chunk] = sum_chunk(positions, triangles.data() + begin, triangles.data() + end, origin);
  });
  double smallest_squared_sine = 1.0;
  for (const ChunkSums& chunk : sums) {
    smallest_squared_sine = std::min(smallest_squared_sine, chunk.smallest_squared_sine);
    measures.volume += chunk.six_volumes / 6.0;
    measures.area += chunk.double_areas / 2.0;
  }
  measures.smallest_angle = std::asin(std::sqrt(smallest_squared_sine)) * 180.0 / M_PI;

  measures.components = connect(positions.size(), triangles).trees;
  // χ = V − E + F with E = 3/2 F on a closed mesh.
  const auto vertex_count = static_cast<std::int64_t>(positions.size());
  const auto face_count = static_cast<std::int64_t>(triangles.size());
  measures.genus = static_cast<std::int64_t>(measures.components) - (2 * vertex_count - face_count) / 4;
  return measures;
}

std::vector<std::uint32_t> vertex_components(std::size_t vertex_count, const std::vector<Triangle>& triangles,
                                             std::size_t& components) {
  Forest forest = connect(vertex_count, triangles);
  components = forest.trees;
  // A parent comes before its children, so it has its label when they ask for it.
  std::vector<std::uint32_t>& labels = forest.parents;
  std::uint32_t next_label = 0;
  for (std::uint32_t vertex = 0; vertex < vertex_count; ++vertex) {
    labels[vertex] = labels[vertex] == vertex ? next_label++ : labels[labels[vertex]];
  }
  return std::move(forest.parents);
}

}  // namespace particle_surface_tracker
