#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// Sizes of a closed triangle mesh.
struct MeshMeasures {
  std::size_t components = 0;  ///< Connected by shared vertices.
  std::int64_t genus = 0;      ///< Sum over the components: components − χ/2.
  double volume = 0.0;         ///< Signed, by the divergence theorem [m³].
  double area = 0.0;           ///< [m²].
  /// Of all triangles [deg], at most 60; 0 where one has no area. Not a number without triangles.
  double smallest_angle = std::numeric_limits<double>::quiet_NaN();
};

/// Measures a mesh whose every vertex is used by a triangle.
MeshMeasures measure_mesh(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles);

/// The connected component of each vertex, numbered in the order of their lowest vertex.
/// \param components receives their number.
std::vector<std::uint32_t> vertex_components(std::size_t vertex_count, const std::vector<Triangle>& triangles,
                                             std::size_t& components);

}  // namespace particle_surface_tracker
