#pragma once

#include <string>
#include <string_view>

namespace particle_surface_tracker {

/// Bytes as text (RFC 4648), in one line.
std::string base64(std::string_view bytes);

}  // namespace particle_surface_tracker
