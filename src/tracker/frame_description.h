#pragma once

#include <cstddef>

#include "particle_surface_tracker/core/frame_report.h"
#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/core/particle_frame.h"
#include "particle_surface_tracker/tracker/tracker_state.h"

namespace particle_surface_tracker {

/// Fills in what a report says of the mesh and of the liquid at the end of a frame.
/// \param surface of the frame; null: none was made.
void describe_frame(FrameReport& report, const TrackedFrame& tracked, const ImplicitSurface* surface,
                    const ParticleFrame& frame);

/// Warns where the ids of a frame cannot be those of its particles: they show as particles that vanish and appear, all
/// over the liquid.
void warn_of_untrue_ids(FrameReport& report, std::size_t particles);

}  // namespace particle_surface_tracker
