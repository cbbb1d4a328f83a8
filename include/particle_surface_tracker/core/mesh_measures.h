#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "particle_surface_tracker/core/triangle_mesh.h"
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

/// As above, with the components that the mesh keeps.
MeshMeasures measure_mesh(const TriangleMesh& mesh);

/// The volume alone, the same bits [m³].
double signed_volume(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles);

}  // namespace particle_surface_tracker
