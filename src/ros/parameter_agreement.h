#pragma once

#include "particle_surface_tracker/core/parameters.h"

namespace particle_surface_tracker {

/// Which parameters have to be those of a checkpoint.
enum class Agreement {
  kAll,             ///< All: the run goes on as if it had never ended.
  kWhatNeedsReset,  ///< Those that cannot change while a mesh is being tracked.
};

/// \param any_spacing the particle spacing is that of the checkpoint, whatever it is.
/// \throw ParameterError that names every parameter that differs, with both values.
void require_agreement(const Parameters& checkpoint, const Parameters& given, Agreement agreement, bool any_spacing);

}  // namespace particle_surface_tracker
