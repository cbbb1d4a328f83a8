#pragma once

#include "particle_surface_tracker/tracker/make_implicit_surface.h"
#include "stage_timer.h"

namespace particle_surface_tracker {

/// As the public function, measured as stages of a frame.
std::shared_ptr<const ImplicitSurface> make_implicit_surface(const ParticleFrame& frame, const Parameters& parameters,
                                                             StageTimer& timer);

}  // namespace particle_surface_tracker
