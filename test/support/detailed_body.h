#pragma once

#include "particle_surface_tracker/core/particle_frame.h"
#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker::test {

/// A body that is hard to carry: a ball with ripples of 0.25 r, spikes, fins and handles of one to two r thickness, at
/// a place and in a pose that no lattice shares. About 20,000 particles and 80,000 triangles.
class DetailedBody {
 public:
  /// \param r spacing of the particles that shall fill it [m].
  explicit DetailedBody(double r);

  const Vec3d& center() const { return center_; }

  /// Negative inside, positive outside, and near the surface about the distance to it [m].
  double distance(const Vec3d& position) const;

  /// The surface, triangulated with edges of about r/3.
  TriangleMesh mesh() const;

  /// A cubic grid of particles at least 0.1 r inside, each then moved by up to `jitter` r along every axis.
  ParticleFrame particles(double jitter) const;

 private:
  double r_;
  Vec3d center_;
};

}  // namespace particle_surface_tracker::test
