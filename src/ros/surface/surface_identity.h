#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/particle_frame.h"

namespace particle_surface_tracker {

/// Names of the parameters that the implicit surface depends on.
const std::vector<std::string>& surface_parameters();

/// Their values, as they stand in a message.
std::string describe_surface_parameters(const Parameters& parameters);

/// CRC-32 of the ids and positions of the particles.
std::uint32_t checksum_of(const ParticleFrame& particles);

}  // namespace particle_surface_tracker
