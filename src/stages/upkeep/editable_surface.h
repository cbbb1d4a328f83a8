#pragma once

#include <cstdint>
#include <vector>

#include "half_edges.h"
#include "particle_surface_tracker/core/triangle_mesh.h"
#include "triangle_shape.h"

namespace particle_surface_tracker {

/// A closed mesh while its connectivity changes: splits, collapses and flips in time proportional to the triangles
/// around them. Triangles and vertices keep their index until finish(), which closes the gaps.
class EditableSurface {
 public:
  /// \param twins as made by pair_half_edges(); kept in step with every operation and with finish().
  EditableSurface(TriangleMesh& mesh, std::vector<std::uint32_t>& twins);

  std::uint32_t vertex_slots() const { return static_cast<std::uint32_t>(mesh_.vertex_count()); }
  std::uint32_t triangle_slots() const { return static_cast<std::uint32_t>(triangles_.size()); }
  bool is_alive(std::uint32_t triangle) const { return triangles_[triangle][0] != kGone; }

  const TriangleMesh& mesh() const { return mesh_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<std::uint32_t>& twins() const { return twins_; }
  const Triangle& triangle(std::uint32_t index) const { return triangles_[index]; }
  Corners corners(std::uint32_t triangle) const { return place_corners(mesh_.positions(), triangles_[triangle]); }
  const Vec3f& stored_position(std::uint32_t vertex) const { return mesh_.positions()[vertex]; }
  Vec3d position(std::uint32_t vertex) const { return mesh_.positions()[vertex].cast<double>(); }

  std::uint32_t start(std::uint32_t half_edge) const { return start_of(triangles_, half_edge); }
  std::uint32_t end(std::uint32_t half_edge) const { return end_of(triangles_, half_edge); }
  std::uint32_t twin(std::uint32_t half_edge) const { return twins_[half_edge]; }
  /// The corner of its triangle that a half-edge does not touch.
  std::uint32_t apex(std::uint32_t half_edge) const { return start(previous_half_edge(half_edge)); }
  /// The half-edge from the start of this one that follows counter-clockwise.
  std::uint32_t turn(std::uint32_t half_edge) const { return twins_[previous_half_edge(half_edge)]; }
  /// Some half-edge that starts from a vertex.
  std::uint32_t outgoing(std::uint32_t vertex) const { return outgoing_[vertex]; }

  /// Calls visit(half_edge) for every half-edge that starts from a vertex, counter-clockwise.
  template <typename Visit>
  void for_each_outgoing(std::uint32_t vertex, Visit&& visit) const {
    const std::uint32_t first = outgoing_[vertex];
    std::uint32_t h = first;
    do {
      visit(h);
      h = turn(h);
    } while (h != first);
  }

  std::uint32_t valence(std::uint32_t vertex) const;

  /// Splits an edge: two triangles become four. The new vertex has a new id; its attributes are blended from
  /// those of the ends, by where along the edge it lies.
  /// \return the new vertex.
  std::uint32_t split(std::uint32_t half_edge, const Vec3f& position);

  /// Collapses an edge onto the end of the half-edge: its start and its two triangles go. The end keeps its id; if it
  /// moves, its attributes are blended like those of a split, else it keeps its own.
  void collapse(std::uint32_t half_edge, const Vec3f& position);

  /// Turns the edge of two triangles so that it connects the two corners that it did not touch.
  void flip(std::uint32_t half_edge);

  /// Writes the triangles back and drops unused vertices.
  /// \return the vertices that are new or have moved: increasing indices.
  std::vector<std::uint32_t> finish();

 private:
  static constexpr std::uint32_t kGone = 0xffffffffU;

  void pair(std::uint32_t a, std::uint32_t b);
  std::uint32_t split_triangle(std::uint32_t half_edge, std::uint32_t middle);
  void remove_triangle(std::uint32_t half_edge);
  void close_gaps();

  TriangleMesh& mesh_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t>& twins_;
  std::vector<std::uint32_t> outgoing_;  // per vertex; kNoHalfEdge where the vertex has gone
  std::vector<bool> is_fresh_;           // per vertex
};

}  // namespace particle_surface_tracker
