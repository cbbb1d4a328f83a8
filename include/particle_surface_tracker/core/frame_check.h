#pragma once

#include "particle_surface_tracker/core/frame_report.h"
#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// Checks the mesh of a frame, in every frame if wanted: fills in the share of self-intersecting triangles, and adds a
/// warning where components are nested as no liquid can be.
/// \throw TrackingError, with what and where, if the mesh is not closed, manifold, consistently oriented and finite.
void check_frame(const TriangleMesh& mesh, FrameReport& report);

}  // namespace particle_surface_tracker
