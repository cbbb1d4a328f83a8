#pragma once

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker::simulator {

/// Another node did not do in time what the simulator waits for.
class TimeoutError : public Error {
 public:
  using Error::Error;
};

}  // namespace particle_surface_tracker::simulator
