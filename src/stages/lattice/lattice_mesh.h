#pragma once

#include <vector>

#include <openvdb/Types.h>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// A mesh on the lattice of Γ, with the cell that each vertex is in.
struct LatticeMesh {
  const std::vector<Vec3f>* positions;  ///< [m]
  const std::vector<Triangle>* triangles;
  double h;                           ///< Cell size [m].
  std::vector<openvdb::Coord> cells;  ///< One per vertex.

  /// \throw MeshError, ParameterError as MeshLattice::MeshLattice().
  LatticeMesh(const std::vector<Vec3f>& mesh_positions, const std::vector<Triangle>& mesh_triangles, double cell_size);

  const Vec3f& position(std::uint32_t vertex) const { return (*positions)[vertex]; }
  const Triangle& triangle(std::uint32_t number) const { return (*triangles)[number]; }

  /// Coordinate of the planes with number k [m].
  double plane(std::int32_t k) const { return static_cast<double>(k) * h; }

  Vec3d node(const openvdb::Coord& n) const { return {plane(n.x()), plane(n.y()), plane(n.z())}; }
};

}  // namespace particle_surface_tracker
