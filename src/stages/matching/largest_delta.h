#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// Largest |δ| of the vertices of a triangle [m].
inline double largest_delta(const Triangle& triangle, const std::vector<float>& delta) {
  double largest = 0.0;
  for (const std::uint32_t v : triangle) largest = std::max(largest, std::abs(static_cast<double>(delta[v])));
  return largest;
}

}  // namespace particle_surface_tracker
