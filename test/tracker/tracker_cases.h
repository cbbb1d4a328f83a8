#pragma once

#include <cmath>

#include "particle_surface_tracker/core/particle_frame.h"
#include "particle_surface_tracker/core/triangle_mesh.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test {

/// Spacing of the particles [m].
inline constexpr double r = 0.1;

/// A sphere with ripples finer than r.
inline TriangleMesh rippled_ball() {
  TriangleMesh mesh = make_sphere(Vec3d::Zero(), 1.0, 5);
  for (Vec3f& x : mesh.positions()) {
    x *= 1.0f + 0.02f * std::sin(25.0f * x.x()) * std::sin(25.0f * x.y()) * std::sin(25.0f * x.z());
  }
  return mesh;
}

/// The particles in it.
inline ParticleFrame ball_of_particles(double jitter = 0.2) {
  return fill_with_particles(Vec3d::Constant(-1.0), Vec3d::Constant(1.0), r, jitter, 9,
                             [](const Vec3d& x) { return x.norm() < 1.0 - 0.1 * r; });
}

template <typename Map>
ParticleFrame moved(const ParticleFrame& frame, Map&& map) {
  ParticleFrame result = frame;
  for (Vec3f& p : result.positions) p = map(p.cast<double>()).template cast<float>();
  return result;
}

inline ParticleFrame shifted(const ParticleFrame& frame, const Vec3d& by) {
  return moved(frame, [&](const Vec3d& x) { return Vec3d(x + by); });
}

}  // namespace particle_surface_tracker::test
