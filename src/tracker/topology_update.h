#pragma once

#include "band.h"
#include "particle_surface_tracker/core/frame_report.h"
#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/topology_cells.h"
#include "particle_surface_tracker/core/triangle_mesh.h"
#include "particle_surface_tracker/stages/detection.h"
#include "particle_surface_tracker/stages/upkeep.h"
#include "stage_timer.h"

namespace particle_surface_tracker {

/// Stages 3 to 5 of a frame: matches the topology of the projected mesh to that of φ (Sec. 6), re-meshes where it
/// changed (Sec. 7), keeps the triangles in shape (Sec. 8), and measures δ of every vertex that is new or has moved.
/// \param particles of the frame [m].
/// \param detection what the projection flagged; where else mesh and φ disagree is found here.
/// \param original_vertices vertices of the first mesh have ids below it.
/// \param band φ of the frame.
/// \param memory kept from frame to frame.
/// \param report receives the counts, and a warning where something could not be done.
/// \param record receives the cells and nodes that were looked at; null: nothing is recorded.
/// \return the largest |δ| of those vertices [m].
double update_topology(TriangleMesh& mesh, const std::vector<Vec3f>& particles, const ImplicitSurface& surface,
                       const Detection& detection, std::uint32_t original_vertices, const Parameters& parameters,
                       NarrowBand& band, UpkeepMemory& memory, FrameReport& report, StageTimer& timer,
                       TopologyCells* record = nullptr);

}  // namespace particle_surface_tracker
