#pragma once

#include <memory>

#include "particle_surface_tracker/core/frame_report.h"
#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/particle_frame.h"

namespace particle_surface_tracker {

/// The implicit surface of one frame and its triangulation (Sec. 5.1), which needs nothing of the frames before: it can
/// be made ahead of the tracking, on another thread or in another process.
/// \param report receives the times that it took; may be null.
/// \throw ParameterError as ParticleGrid.
std::shared_ptr<const ImplicitSurface> make_implicit_surface(const ParticleFrame& frame, const Parameters& parameters,
                                                             FrameReport* report = nullptr);

}  // namespace particle_surface_tracker
