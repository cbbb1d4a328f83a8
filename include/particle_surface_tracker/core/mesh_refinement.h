#pragma once

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// Splits edges at their midpoints until none is longer than `max_edge_length` [m]. The shape does not change: every
/// new vertex lies on the edge that it splits. Longest edges first, ties by index; attributes are blended.
/// \param mesh closed and manifold; so it stays.
/// \throw ParameterError if max_edge_length is not a positive number, or so small that it takes 50 million vertices.
void split_long_edges(TriangleMesh& mesh, double max_edge_length);

}  // namespace particle_surface_tracker
