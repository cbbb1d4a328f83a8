#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "particle_surface_tracker/core/types.h"
#include "particle_surface_tracker/core/vertex_attributes.h"
#include "particle_surface_tracker/core/vertex_components.h"

namespace particle_surface_tracker {

/// The explicit surface mesh: positions, triangles, a persistent id per vertex, and attributes that follow every
/// change.
///
/// Every vertex has δ, its signed distance [m] to the isosurface φ = 0, negative inside (Sec. 5.2); it is 0 until it
/// has been measured. An id is given once and never again: a vertex of the first mesh keeps its id for as long as it
/// lives.
class TriangleMesh {
 public:
  TriangleMesh();

  /// Takes positions [m] and triangles as they are; ids count up from 0, δ is 0.
  /// \throw MeshError if a triangle names a vertex that is not there.
  TriangleMesh(std::vector<Vec3f> positions, std::vector<Triangle> triangles);

  /// As above, with the ids that the vertices had before.
  /// \throw MeshError, also if there is not one id per vertex, or one occurs twice.
  TriangleMesh(std::vector<Vec3f> positions, std::vector<Triangle> triangles, std::vector<std::uint32_t> ids);

  std::size_t vertex_count() const { return positions_.size(); }
  std::size_t triangle_count() const { return triangles_.size(); }

  const std::vector<Vec3f>& positions() const { return positions_; }
  std::vector<Vec3f>& positions() { return positions_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }

  /// A number that changes whenever the triangles do, never 0: meshes with the same one have the same triangles. A copy
  /// keeps it.
  std::uint64_t connectivity() const { return connectivity_; }

  /// The connected components of the vertices: worked out when they are first asked for and kept while the triangles
  /// stay. Not to be asked for by several threads at a time.
  std::shared_ptr<const VertexComponents> components() const;

  /// Replaces all triangles.
  /// \throw MeshError if one names a vertex that is not there; the mesh is unchanged then.
  void set_triangles(std::vector<Triangle> triangles);

  const std::vector<std::uint32_t>& ids() const { return ids_; }

  /// The id that the next new vertex gets: all ids so far are below it.
  std::uint32_t next_id() const { return next_id_; }

  /// Takes the ids below `next_id` for given, to vertices that have gone.
  /// \throw MeshError if a vertex has a higher one.
  void reserve_ids(std::uint32_t next_id);

  const std::vector<float>& delta() const { return attributes_[delta_].values; }
  std::vector<float>& delta() { return attributes_[delta_].values; }

  const VertexAttributes& attributes() const { return attributes_; }
  VertexAttributes& attributes() { return attributes_; }

  /// Appends a vertex with a new id, whose attributes are blended from others.
  /// \return its index.
  std::uint32_t append_vertex(const Vec3f& position, const VertexBlend& blend);

  /// Drops the vertices that no triangle uses; the others keep their order, ids and attributes.
  void remove_unused_vertices();

  /// Name of the attribute of δ.
  static constexpr const char* delta_name = "delta";
  /// Colour: red, green, blue, alpha, each in [0, 1].
  static constexpr const char* color_name = "color";
  /// Texture coordinates u, v.
  static constexpr const char* texcoord_name = "texcoord";

 private:
  std::vector<Vec3f> positions_;
  std::vector<Triangle> triangles_;
  std::uint64_t connectivity_;
  mutable std::shared_ptr<const VertexComponents> components_;  // null: not worked out
  std::vector<std::uint32_t> ids_;
  std::uint32_t next_id_ = 0;
  VertexAttributes attributes_;
  std::size_t delta_ = 0;
};

}  // namespace particle_surface_tracker
