#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "particle_surface_tracker/core/triangle_mesh.h"
#include "particle_surface_tracker/stages/mesh_lattice.h"

namespace particle_surface_tracker::remeshing {

/// A vertex that re-meshing makes.
struct PatchVertex {
  enum class Kind : std::uint8_t {
    kFront,  ///< Where the mesh crosses the front: `point`. It lies on the mesh.
    kEdge,   ///< On a lattice edge among marked cells: `point.node`, `point.axis`.
    kCenter  ///< In the middle of a loop in a marked cell: `point.node`.
  };
  Kind kind = Kind::kFront;
  LatticePoint point;
  Vec3d position = Vec3d::Zero();  ///< [m]
  VertexBlend blend;               ///< Of vertices of the mesh, for the attributes.
};

/// What takes the place of the triangles that are removed from a mesh. Vertices of the mesh keep their indices, the new
/// ones follow.
class Patch {
 public:
  explicit Patch(std::size_t mesh_vertices) : first_vertex_(static_cast<std::uint32_t>(mesh_vertices)) {}

  std::vector<PatchVertex> vertices;
  std::vector<std::uint32_t> removed;  ///< Triangles of the mesh, increasing.
  std::vector<Triangle> triangles;     ///< First what is left of cut triangles, then the filling.
  std::size_t first_filling = 0;       ///< The first triangle of the filling.

  std::uint32_t first_vertex() const { return first_vertex_; }
  bool is_new(std::uint32_t vertex) const { return vertex >= first_vertex_; }
  PatchVertex& vertex(std::uint32_t index) { return vertices[index - first_vertex_]; }
  const PatchVertex& vertex(std::uint32_t index) const { return vertices[index - first_vertex_]; }

  std::uint32_t add(PatchVertex::Kind kind, const LatticePoint& point) {
    vertices.push_back({kind, point, Vec3d::Zero(), {}});
    return first_vertex_ + static_cast<std::uint32_t>(vertices.size()) - 1;
  }

  /// The vertex where the mesh crosses the front; made where it is not there yet.
  std::uint32_t front_vertex(const LatticePoint& point) {
    const auto [place, is_new] = front_.emplace(point, 0);
    if (is_new) place->second = add(PatchVertex::Kind::kFront, point);
    return place->second;
  }

  static constexpr std::uint32_t none = 0xffffffff;

  /// The vertex where the mesh crosses the front, or `none`.
  std::uint32_t find_front_vertex(const LatticePoint& point) const {
    const auto place = front_.find(point);
    return place == front_.end() ? none : place->second;
  }

 private:
  std::uint32_t first_vertex_;
  std::unordered_map<LatticePoint, std::uint32_t, LatticeHash> front_;
};

}  // namespace particle_surface_tracker::remeshing
