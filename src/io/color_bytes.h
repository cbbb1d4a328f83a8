#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace particle_surface_tracker {

/// A colour from 0 to 1 as a byte. NaN becomes 0.
inline std::uint8_t color_byte(float value) {
  return value > 0.0F ? static_cast<std::uint8_t>(std::lround(std::min(value, 1.0F) * 255.0F)) : std::uint8_t{0};
}

}  // namespace particle_surface_tracker
