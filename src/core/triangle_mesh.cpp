#include "particle_surface_tracker/core/triangle_mesh.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {

namespace {

std::uint64_t new_connectivity() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

void check_indices(const std::vector<Triangle>& triangles, std::size_t vertex_count) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t vertex : triangles[t]) {
      if (vertex >= vertex_count) {
        throw MeshError(
            fmt::format("triangle {} names vertex {}, but the mesh has {} vertices", t, vertex, vertex_count));
      }
    }
  }
}

void check_ids(std::vector<std::uint32_t> ids, std::size_t vertex_count) {
  if (ids.size() != vertex_count) {
    throw MeshError(fmt::format("the mesh has {} vertices, but there are {} ids", vertex_count, ids.size()));
  }
  std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (twice != ids.end()) throw MeshError(fmt::format("two vertices have the id {}", *twice));
}

}  // namespace

TriangleMesh::TriangleMesh() : connectivity_(new_connectivity()), delta_(attributes_.add(delta_name, 1, {0.0f})) {}

TriangleMesh::TriangleMesh(std::vector<Vec3f> positions, std::vector<Triangle> triangles) : TriangleMesh() {
  check_indices(triangles, positions.size());
  positions_ = std::move(positions);
  triangles_ = std::move(triangles);
  ids_.resize(positions_.size());
  std::iota(ids_.begin(), ids_.end(), 0u);
  next_id_ = static_cast<std::uint32_t>(ids_.size());
  attributes_.resize(positions_.size());
}

TriangleMesh::TriangleMesh(std::vector<Vec3f> positions, std::vector<Triangle> triangles,
                           std::vector<std::uint32_t> ids)
    : TriangleMesh(std::move(positions), std::move(triangles)) {
  check_ids(ids, positions_.size());
  ids_ = std::move(ids);
  next_id_ = ids_.empty() ? 0u : *std::max_element(ids_.begin(), ids_.end()) + 1;
}

void TriangleMesh::set_triangles(std::vector<Triangle> triangles) {
  check_indices(triangles, positions_.size());
  triangles_ = std::move(triangles);
  connectivity_ = new_connectivity();
  components_.reset();
}

std::shared_ptr<const VertexComponents> TriangleMesh::components() const {
  if (!components_)
    components_ = std::make_shared<const VertexComponents>(vertex_components(vertex_count(), triangles_));
  return components_;
}

void TriangleMesh::reserve_ids(std::uint32_t next_id) {
  if (next_id < next_id_) {
    throw MeshError(fmt::format("ids below {} cannot be the only ones given: there is id {}", next_id, next_id_ - 1));
  }
  next_id_ = next_id;
}

std::uint32_t TriangleMesh::append_vertex(const Vec3f& position, const VertexBlend& blend) {
  attributes_.append_blend(blend);
  positions_.push_back(position);
  ids_.push_back(next_id_++);
  components_.reset();
  return static_cast<std::uint32_t>(positions_.size() - 1);
}

void TriangleMesh::remove_unused_vertices() {
  constexpr std::uint32_t unused = 0xffffffffu;
  std::vector<std::uint32_t> new_index(positions_.size(), unused);
  for (const Triangle& triangle : triangles_) {
    for (const std::uint32_t vertex : triangle) new_index[vertex] = 0;
  }
  std::vector<std::uint32_t> kept;
  for (std::uint32_t vertex = 0; vertex < new_index.size(); ++vertex) {
    if (new_index[vertex] == unused) continue;
    new_index[vertex] = static_cast<std::uint32_t>(kept.size());
    positions_[kept.size()] = positions_[vertex];
    ids_[kept.size()] = ids_[vertex];
    kept.push_back(vertex);
  }
  positions_.resize(kept.size());
  ids_.resize(kept.size());
  attributes_.keep(kept);
  for (Triangle& triangle : triangles_) {
    for (std::uint32_t& vertex : triangle) vertex = new_index[vertex];
  }
  connectivity_ = new_connectivity();
  components_.reset();
}

}  // namespace particle_surface_tracker
