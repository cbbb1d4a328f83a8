#pragma once

#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// What surrounded a vertex when it was first seen. An edge or triangle is compared with the strictest of its vertices'
/// records that its own state at birth still met, so that a mesh as it was born never calls for an operation.
struct BirthRecord {
  float shortest_edge = 0.0F;   ///< [m]; of the edges at the vertex.
  float longest_edge = 0.0F;    ///< [m]; 0 where nothing has been noted yet.
  float smallest_angle = 0.0F;  ///< [rad]; of the triangles at the vertex.
  float largest_fold = 0.0F;    ///< [rad]; largest fold_between() at the edges of the vertex.
  float remeshed = 0.0F;        ///< 1 for vertices made by re-meshing and what came of them alone, else less.
};

/// The records of all vertices; they live in a vertex attribute and follow every operation.
class BirthRecords {
 public:
  /// Registers the attribute where it is missing.
  explicit BirthRecords(TriangleMesh& mesh);

  bool is_noted(std::uint32_t vertex) const { return of(vertex).longest_edge > 0.0F; }

  /// Whether all vertices have been noted.
  bool all_noted() const;

  /// Measures the vertices that have not been noted.
  /// \param twins as made by pair_half_edges().
  void note_missing(const std::vector<std::uint32_t>& twins);

  /// Makes a vertex one that re-meshing has made and that has not been noted yet.
  void begin_remeshed(std::uint32_t vertex);

  /// Whether re-meshing alone has made the surface at a vertex, which therefore carries no detail of the first mesh.
  bool is_remeshed(std::uint32_t vertex) const;

  /// Length above which no edge between two vertices was at birth [m].
  double longest_edge(std::uint32_t a, std::uint32_t b) const;
  /// Length below which no edge between two vertices was at birth [m].
  double shortest_edge(std::uint32_t a, std::uint32_t b) const;
  /// Angle above which no edge between two vertices was folded at birth [rad].
  double largest_fold(std::uint32_t a, std::uint32_t b) const;
  /// Angle below which no triangle of three vertices had any at birth [rad].
  double smallest_angle(const Triangle& triangle) const;

 private:
  BirthRecord of(std::uint32_t vertex) const;
  void set(std::uint32_t vertex, const BirthRecord& record);

  TriangleMesh& mesh_;
  std::size_t attribute_;
};

/// As BirthRecords::longest_edge(), of a mesh that may have no records: 0 where nothing has been noted [m].
double longest_edge_at_birth(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b);

}  // namespace particle_surface_tracker
