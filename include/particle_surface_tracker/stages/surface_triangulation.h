#pragma once

#include "particle_surface_tracker/core/implicit_surface.h"

namespace particle_surface_tracker {

/// Triangulates the zero level of a field given at all corners of every cell that it passes through (Sec. 5.1).
///
/// A value below 0 is inside. One vertex lies on every lattice edge whose ends differ, at the linear zero, kept off the
/// ends by a thousandth of the edge, so that no two vertices coincide. The result is closed and manifold for every
/// pattern of signs: both cells at an ambiguous face cut it the same way (the inside corners stay apart), and no
/// diagonal of a cell runs inside a face.
/// \param field active nodes hold values [m]; node (i, j, k) is at dx · (i, j, k).
/// \throw TrackingError if a cell that the surface passes through lacks a corner.
SurfaceTriangulation triangulate_zero_level(const openvdb::FloatGrid& field, double dx);

}  // namespace particle_surface_tracker
