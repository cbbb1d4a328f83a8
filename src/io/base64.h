#pragma once

#include <string>
#include <string_view>

namespace particle_surface_tracker {

/// Appends bytes as base64 (RFC 4648), in one line.
void append_base64(std::string& text, std::string_view bytes);

}  // namespace particle_surface_tracker
