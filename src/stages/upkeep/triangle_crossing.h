#pragma once

#include "triangle_shape.h"

namespace particle_surface_tracker {

/// A triangle of a mesh and where it lies.
struct PlacedTriangle {
  Triangle vertices;
  Corners corners;
  Vec3d normal;  ///< area_normal().
};

inline PlacedTriangle place_triangle(const Triangle& vertices, const Corners& corners) {
  return {vertices, corners, area_normal(corners)};
}

/// Whether two triangles have more in common than the corner that they share by index. Two that share an edge do not
/// count: that is a matter of folds.
bool triangles_cross(const PlacedTriangle& a, const PlacedTriangle& b);

}  // namespace particle_surface_tracker
