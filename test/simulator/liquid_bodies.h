#pragma once

#include <vector>

#include "particle_surface_tracker/core/particle_frame.h"
#include "simulator_parameters.h"

namespace particle_surface_tracker::simulator {

inline constexpr double test_spacing = 0.025;  // [m]

/// Defaults with the spacing of the tests.
inline SimulatorParameters test_parameters() {
  SimulatorParameters parameters;
  parameters.spacing = test_spacing;
  return parameters;
}

/// Particles on a cubic grid of nx × ny × nz, the first of them at `corner`; ids count up.
inline ParticleFrame block(const Vec3d& corner, int nx, int ny, int nz, const Vec3f& velocity = Vec3f::Zero()) {
  ParticleFrame frame;
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) {
      for (int k = 0; k < nz; ++k) {
        frame.ids.push_back(static_cast<std::uint32_t>(frame.ids.size()));
        frame.positions.push_back((corner + test_spacing * Vec3d(i, j, k)).cast<float>());
        frame.velocities.push_back(velocity);
      }
    }
  }
  return frame;
}

/// Both of two bodies; the ids of the second follow those of the first.
inline ParticleFrame both(ParticleFrame first, const ParticleFrame& second) {
  const auto count = static_cast<std::uint32_t>(first.size());
  for (const std::uint32_t id : second.ids) first.ids.push_back(count + id);
  first.positions.insert(first.positions.end(), second.positions.begin(), second.positions.end());
  first.velocities.insert(first.velocities.end(), second.velocities.begin(), second.velocities.end());
  return first;
}

}  // namespace particle_surface_tracker::simulator
