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

/// Length of the longest edge of a triangle [m].
inline double longest_edge(const std::vector<Vec3f>& positions, const Triangle& triangle) {
  double largest = 0.0;
  for (int i = 0; i < 3; ++i) {
    const Vec3f edge = positions[triangle[(i + 1) % 3]] - positions[triangle[i]];
    largest = std::max(largest, edge.cast<double>().squaredNorm());
  }
  return std::sqrt(largest);
}

}  // namespace particle_surface_tracker
