#pragma once

#include <cstdint>
#include <vector>

#include <openvdb/openvdb.h>

#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/triangle_mesh.h"
#include "particle_surface_tracker/stages/projection.h"

namespace particle_surface_tracker {

/// Where the topology of the implicit surface may have changed (Sec. 5.3).
struct Detection {
  std::vector<std::uint32_t> flagged_vertices;  ///< Increasing indices: |x − x_proj| > τ, or no φ = 0 within reach.
  std::vector<openvdb::Coord> flagged_cells;  ///< Cells of Γ that hold a triangle of a flagged vertex, sorted, unique.
  std::size_t unreached_vertices = 0;         ///< Of the flagged: those whose search found nothing.
};

/// Moves the vertices of `mesh` to their projections, except those that would move by more than τ: they are put back at
/// their advected position and the cells of Γ that their triangles meet are flagged (Sec. 5.3).
/// \param mesh holds the advected positions.
Detection apply_projection(TriangleMesh& mesh, const Projection& projection, const Parameters& parameters);

}  // namespace particle_surface_tracker
