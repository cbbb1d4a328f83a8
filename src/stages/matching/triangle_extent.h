#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <openvdb/math/Proximity.h>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// Largest |δ| of the vertices of a triangle [m].
inline double largest_delta(const Triangle& triangle, const std::vector<float>& delta) {
  double largest = 0.0;
  for (const std::uint32_t v : triangle) largest = std::max(largest, std::abs(static_cast<double>(delta[v])));
  return largest;
}

/// The corners of a triangle, as OpenVDB has positions.
using Corners = std::array<openvdb::Vec3d, 3>;

inline Corners corners_of(const std::vector<Vec3f>& positions, const Triangle& triangle) {
  Corners corners;
  for (int i = 0; i < 3; ++i) {
    const Vec3f& x = positions[triangle[i]];
    corners[i] = {x.x(), x.y(), x.z()};
  }
  return corners;
}

/// Squared distance of a place from a triangle [m²].
inline double squared_distance(const Corners& corners, const openvdb::Vec3d& place) {
  openvdb::Vec3d unused;
  const openvdb::Vec3d closest =
      openvdb::math::closestPointOnTriangleToPoint(corners[0], corners[1], corners[2], place, unused);
  return (closest - place).lengthSqr();
}

/// False only if no edge of a triangle is longer than a length; in floats, with a margin for their rounding.
/// \param squared_length [m²].
inline bool may_be_longer(const std::vector<Vec3f>& positions, const Triangle& triangle, float squared_length) {
  const Vec3f &a = positions[triangle[0]], &b = positions[triangle[1]], &c = positions[triangle[2]];
  const float longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  constexpr float kMargin = 0.9999F;
  return !(longest <= kMargin * squared_length);
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
