#pragma once

#include "particle_surface_tracker/core/parameters.h"

namespace particle_surface_tracker::test {

/// The default parameters for particles of some spacing r [m].
inline Parameters parameters_with_spacing(double r) {
  Parameters parameters;
  parameters.particle_spacing = r;
  return parameters;
}

}  // namespace particle_surface_tracker::test
