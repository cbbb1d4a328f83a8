#pragma once

#include <memory>

#include <particle_surface_tracker/ParticleSurface.h>
#include <std_msgs/Header.h>

#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/particle_frame.h"

namespace particle_surface_tracker {

/// The message that carries a surface, with all that tells what it was made of.
ParticleSurface to_surface_message(const std_msgs::Header& header, const ImplicitSurface& surface,
                                   const ParticleFrame& particles, const Parameters& parameters);

/// The surface that a message carries: the one that was put into it, bit for bit.
/// \throw InputError that names the field, if the arrays of the message do not fit each other.
std::shared_ptr<const ImplicitSurface> to_surface(const ParticleSurface& message);

/// Checks that a message is about these particles and was made with these parameters.
/// \throw InputError that says what differs.
void require_made_of(const ParticleSurface& message, const ParticleFrame& particles, const Parameters& parameters);

}  // namespace particle_surface_tracker
