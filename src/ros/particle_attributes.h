#pragma once

#include <string>
#include <vector>

#include <particle_surface_tracker/InterpolatedField.h>
#include <sensor_msgs/PointCloud2.h>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// Values that the particles of a cloud carry.
struct ParticleAttributes {
  /// One attribute; particles without a finite value have NaN.
  struct Attribute {
    std::string name;
    std::size_t components = 1;
    std::vector<float> values;  ///< `components` for each particle, particle by particle.
  };

  std::vector<Vec3f> positions;  ///< [m], in the order of their ids.
  std::vector<Attribute> attributes;
  std::vector<std::string> missing;  ///< What the cloud does not have, each in words.
};

/// Reads attributes by name: `velocity` is vx vy vz, `rgb` and `rgba` are four numbers in [0, 1] from a packed colour,
/// any other name is a scalar field, FLOAT32 or FLOAT64.
/// \pre check_particle_cloud() passes.
ParticleAttributes read_particle_attributes(const sensor_msgs::PointCloud2& cloud,
                                            const std::vector<std::string>& names);

/// Attributes at the vertices of a mesh: means over the particles within 2 r, weighted by (1 − (d / 2r)²)³, as
/// advection weights displacements. A vertex that has none so near takes the values of the nearest particle.
/// \param vertices [m]
/// \param r particle spacing [m].
std::vector<InterpolatedField> interpolate(const ParticleAttributes& particles, const std::vector<Vec3f>& vertices,
                                           double r);

}  // namespace particle_surface_tracker
