#include "particle_surface_tracker/core/mesh_measures.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>
#include <Eigen/Geometry>

#include "particle_surface_tracker/core/vertex_components.h"

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

/// Sums over all triangles, each chunk by itself.
/// \param add called as add(sums, edge_ab, edge_ac, normal): what else to sum for each triangle.
template <typename Add>
std::vector<ChunkSums> sum_chunks(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles,
                                  Add&& add) {
  // An origin on the mesh instead of far away keeps the terms of the volume small.
  const Vec3d origin = positions[triangles.front()[0]].cast<double>();
  const std::size_t chunk_count = (triangles.size() + kTrianglesPerChunk - 1) / kTrianglesPerChunk;
  std::vector<ChunkSums> sums(chunk_count);
  tbb::parallel_for(std::size_t{0}, chunk_count, [&](std::size_t chunk) {
    const std::size_t begin = chunk * kTrianglesPerChunk;
    const std::size_t end = std::min(begin + kTrianglesPerChunk, triangles.size());
    ChunkSums of_chunk;
    for (std::size_t t = begin; t < end; ++t) {
      const Vec3d a = positions[triangles[t][0]].cast<double>();
      const Vec3d edge_ab = positions[triangles[t][1]].cast<double>() - a;
      const Vec3d edge_ac = positions[triangles[t][2]].cast<double>() - a;
      const Vec3d normal = edge_ab.cross(edge_ac);
      of_chunk.six_volumes += normal.dot(a - origin);
      add(of_chunk, edge_ab, edge_ac, normal);
    }
    sums[chunk] = of_chunk;
  });
  return sums;
}

MeshMeasures measure(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles,
                     std::size_t components) {
  MeshMeasures measures;
  double smallest_squared_sine = 1.0;
  const auto add = [](ChunkSums& sums, const Vec3d& edge_ab, const Vec3d& edge_ac, const Vec3d& normal) {
    sums.double_areas += normal.norm();
    sums.smallest_squared_sine = std::min(sums.smallest_squared_sine, squared_sine(edge_ab, edge_ac, normal));
  };
  for (const ChunkSums& chunk : sum_chunks(positions, triangles, add)) {
    smallest_squared_sine = std::min(smallest_squared_sine, chunk.smallest_squared_sine);
    measures.volume += chunk.six_volumes / 6.0;
    measures.area += chunk.double_areas / 2.0;
  }
  measures.smallest_angle = std::asin(std::sqrt(smallest_squared_sine)) * 180.0 / M_PI;

  measures.components = components;
  // χ = V − E + F with E = 3/2 F on a closed mesh.
  const auto vertex_count = static_cast<std::int64_t>(positions.size());
  const auto face_count = static_cast<std::int64_t>(triangles.size());
  measures.genus = static_cast<std::int64_t>(measures.components) - (2 * vertex_count - face_count) / 4;
  return measures;
}

}  // namespace

MeshMeasures measure_mesh(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
  if (triangles.empty()) return {};
  return measure(positions, triangles, vertex_components(positions.size(), triangles).count);
}

MeshMeasures measure_mesh(const TriangleMesh& mesh) {
  if (mesh.triangles().empty()) return {};
  return measure(mesh.positions(), mesh.triangles(), mesh.components()->count);
}

double signed_volume(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
  if (triangles.empty()) return 0.0;
  double volume = 0.0;
  const auto nothing_else = [](ChunkSums&, const Vec3d&, const Vec3d&, const Vec3d&) {};
  for (const ChunkSums& chunk : sum_chunks(positions, triangles, nothing_else)) volume += chunk.six_volumes / 6.0;
  return volume;
}

}  // namespace particle_surface_tracker
