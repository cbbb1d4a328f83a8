#pragma once

#include <cstdint>
#include <vector>

#include "band.h"
#include "particle_surface_tracker/core/frame_report.h"
#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// A vertex that is new or has moved.
struct FreshVertex {
  std::uint32_t index;
  bool is_remeshed;  ///< Else upkeep has made or moved it.
  bool has_detail;   ///< False in a component that has no vertex of the first mesh.
};

/// Measures δ of vertices that are new or have moved, where they are now, by the search that projects (Sec. 5.2).
///
/// What is measured must not make a place of the surface out of one that is only waiting to be put right: beside a
/// vertex that was flagged and put back, a new one would otherwise take the whole gap for detail, and the gap would
/// never be flagged again. So δ of a vertex that upkeep made stays within that of its neighbours, and δ of a re-meshed
/// one within τ of what it was blended from; the next projection moves the vertex by the rest or flags it. Where there
/// is no detail δ is 0: what smoothing takes off small drops would else be kept for ever, and they are made anew again
/// and again.
/// \param fresh vertices with a blended δ.
/// \param band φ of the frame.
/// \return the largest |δ| of those vertices [m].
double measure_fresh_delta(TriangleMesh& mesh, const std::vector<FreshVertex>& fresh, NarrowBand& band,
                           const Parameters& parameters, FrameReport& report);

}  // namespace particle_surface_tracker
