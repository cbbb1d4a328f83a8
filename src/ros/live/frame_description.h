#pragma once

#include <particle_surface_tracker/TrackerStatus.h>

#include "particle_surface_tracker/core/frame_report.h"
#include "particle_surface_tracker/tracker/tracker.h"
#include "ros/live/tracked_view.h"

namespace particle_surface_tracker {

/// Writes what a report says into a status.
void describe(const FrameReport& report, TrackerStatus& status);

/// What is to be seen of a tracked frame, all but mesh message and events.
/// \param first_new_id vertices that this frame made have ids from here on; those of re-meshing come first.
TrackedView view_of(const Tracker& tracker, const FrameReport& report, std::uint32_t first_new_id);

}  // namespace particle_surface_tracker
