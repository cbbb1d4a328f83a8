#pragma once

#include <cmath>

#include <openvdb/openvdb.h>

#include "particle_surface_tracker/core/signed_distance_field.h"
#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker::test {

/// A distance field from an analytic function, at the nodes of a box where |value| ≤ reach.
template <typename Function>
SignedDistanceField make_field(const Vec3d& lower, const Vec3d& upper, double dx, double reach, Function&& function) {
  SignedDistanceField field;
  field.dx = dx;
  field.reach = reach;
  field.phi = openvdb::FloatGrid::create(SignedDistanceField::absent);
  auto accessor = field.phi->getAccessor();
  for (int i = static_cast<int>(std::floor(lower.x() / dx)); i * dx <= upper.x(); ++i) {
    for (int j = static_cast<int>(std::floor(lower.y() / dx)); j * dx <= upper.y(); ++j) {
      for (int k = static_cast<int>(std::floor(lower.z() / dx)); k * dx <= upper.z(); ++k) {
        const double value = function(Vec3d(i * dx, j * dx, k * dx));
        if (std::abs(value) <= reach) accessor.setValue(openvdb::Coord(i, j, k), static_cast<float>(value));
      }
    }
  }
  return field;
}

}  // namespace particle_surface_tracker::test
