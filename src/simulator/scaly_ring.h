#pragma once

#include "particle_surface_tracker/core/particle_frame.h"
#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker::simulator {

/// A ring around the z axis whose tube has twisted lobes, covered with overlapping scales that carry a keel: relief
/// much finer than the particles inside it. Every meridian section is star-shaped around the tube's centre line, so the
/// mesh cannot cross itself.
class ScalyRing {
 public:
  /// The closed mesh, 40,960 vertices and 81,920 triangles, outward, with a colour per vertex. The grooves between the
  /// scales lie on edges.
  TriangleMesh mesh() const;

  /// Particles on a cubic grid inside the mesh, none of them near its surface.
  /// \param spacing of the grid [m].
  ParticleFrame fill(const TriangleMesh& mesh, double spacing) const;

 private:
  /// Radius of the tube [m] at u (around the z axis) and v (around the tube), both in turns.
  double tube_radius(double u, double v) const;
};

}  // namespace particle_surface_tracker::simulator
