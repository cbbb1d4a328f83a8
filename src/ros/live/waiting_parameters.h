#pragma once

#include <string>

#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/io/checkpoint.h"

namespace particle_surface_tracker {

/// Name of the section of a checkpoint that holds the parameters that the node had come up with.
constexpr const char* configured_section = "configured";

/// The values, without dynamic_reconfigure, of those parameters that cannot change while a mesh is being tracked.
std::string to_bytes(const Parameters& configured);

/// Checks that nobody has configured a node otherwise than the one that wrote a checkpoint. What dynamic_reconfigure
/// alone has changed, there or here, is no contradiction: the values of the checkpoint are in force then, and the
/// others wait for a reset.
/// \param any_spacing the particle spacing is that of the checkpoint, whatever it is.
/// \throw ParameterError that names every parameter that is neither as in the checkpoint nor as it was configured there.
/// \throw InputError if the section is damaged. A checkpoint without it counts as configured as it is.
void require_not_configured_otherwise(const Checkpoint& checkpoint, const Parameters& configured, bool any_spacing);

/// Parameters with the values in force of those that cannot change while a mesh is being tracked, but for the spacing.
Parameters with_values_in_force(Parameters wanted, const Parameters& in_force);

/// Those that wait for a reset, as "dx_phi 0.5 -> 0.75"; empty if there are none.
std::string describe_waiting(const Parameters& in_force, const Parameters& wanted);

}  // namespace particle_surface_tracker
