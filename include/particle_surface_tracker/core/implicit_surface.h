#pragma once

#include <cstdint>
#include <vector>

#include <openvdb/openvdb.h>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// One cell of the lattice of Δx_φ that the isosurface passes through.
struct CutCell {
  openvdb::Coord origin;             ///< Its corner with the smallest coordinates [cells].
  std::uint32_t first_triangle = 0;  ///< Its triangles run from here to the next cell's first one.
};

/// The isosurface φ̃ = 0 as a closed, oriented 2-manifold, in the order of the cells that made it.
struct SurfaceTriangulation {
  std::vector<Vec3f> vertices;      ///< [m].
  std::vector<Triangle> triangles;  ///< Counter-clockwise seen from outside (φ̃ ≥ 0).
  std::vector<CutCell> cells;       ///< In a fixed order; one more entry at the end closes the last range.
};

/// The implicit surface of one frame of particles. It knows nothing of the mesh, so that it can be made one frame ahead
/// or in another process.
struct ImplicitSurface {
  double dx = 0.0;  ///< Δx_φ [m].

  /// φ̃ [m] at the nodes next to the isosurface (the active ones; node (i, j, k) is at dx · (i, j, k)); negative inside.
  openvdb::FloatGrid::Ptr field;

  SurfaceTriangulation triangulation;
};

}  // namespace particle_surface_tracker
