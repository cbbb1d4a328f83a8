#pragma once

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker::demo {

/// A flow without divergence that starts from rest, stretches along x, twists around x and bends like a saddle.
class TwistingFlow {
 public:
  /// Velocity [m/s] at a position [m].
  /// \param time from 0 (rest) to 1 [s].
  Vec3d velocity(const Vec3d& position, double time) const;

  /// Where a particle is after following the flow, by the classical Runge–Kutta method in equal steps.
  Vec3d follow(Vec3d position, double time, double duration, int steps) const;
};

}  // namespace particle_surface_tracker::demo
