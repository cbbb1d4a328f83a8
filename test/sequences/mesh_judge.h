#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/types.h"

// Judgements of triangle meshes that share no code with the library, so that both have to be wrong in the same way
// before a fault goes unseen.

namespace particle_surface_tracker::test {

/// What keeps a mesh from being a closed, consistently oriented 2-manifold.
struct SurfaceDefects {
  std::size_t degenerate_triangles = 0;   ///< With two equal indices.
  std::size_t open_edges = 0;             ///< With one triangle.
  std::size_t non_manifold_edges = 0;     ///< With more than two triangles.
  std::size_t flipped_edges = 0;          ///< With two triangles that run along it in the same direction.
  std::size_t non_manifold_vertices = 0;  ///< With more than one umbrella of triangles.
  std::size_t unused_vertices = 0;

  bool none() const {
    return degenerate_triangles + open_edges + non_manifold_edges + flipped_edges + non_manifold_vertices +
               unused_vertices ==
           0;
  }
};

SurfaceDefects find_surface_defects(std::size_t vertex_count, const std::vector<Triangle>& triangles);

/// Number of triangles that intersect another one in more than the vertex or edge that they share; exact.
/// \throw std::invalid_argument if the triangles are not a manifold (find_surface_defects() tells).
std::size_t count_self_intersecting_triangles(const std::vector<Vec3f>& positions,
                                              const std::vector<Triangle>& triangles);

/// Number of triangles that face away from the surface around them: whose normal has a negative dot product with the
/// sum of the area-weighted normals of the one-rings of its three vertices.
std::size_t count_inverted_triangles(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles);

/// Signed volume of a closed mesh [m³].
double enclosed_volume(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles);

/// The triangles with vertices of the same position replaced by one of them, as by a reader that joins vertices.
/// \param positions must be finite.
std::vector<Triangle> welded_by_position(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles);

/// Number of connected pieces that the vertices `members` form along the edges between them.
std::size_t count_clusters(std::size_t vertex_count, const std::vector<Triangle>& triangles,
                           const std::vector<std::uint32_t>& members);

}  // namespace particle_surface_tracker::test
