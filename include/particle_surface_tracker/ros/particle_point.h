#pragma once

#include <cstdint>

// The point types are registered here for use with PCL's templates.
#define PCL_NO_PRECOMPILE
#include <pcl/point_types.h>
#include <pcl/register_point_struct.h>

namespace particle_surface_tracker {

/// A particle as PCL sees it: what the tracker reads from a cloud, and nothing else.
///
///     pcl::PointCloud<particle_surface_tracker::ParticlePoint> particles;
///     sensor_msgs::PointCloud2 cloud;
///     pcl::toROSMsg(particles, cloud);    // ready for the topic of the tracker
///     pcl::fromROSMsg(cloud, particles);  // fields are found by name; check_particle_cloud() tells beforehand if all
///     are there
struct EIGEN_ALIGN16 ParticlePoint {
  PCL_ADD_POINT4D  // x, y, z [m]
      std::uint32_t id = 0;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

/// The same with a velocity.
struct EIGEN_ALIGN16 MovingParticlePoint {
  PCL_ADD_POINT4D  // x, y, z [m]
      std::uint32_t id = 0;
  float vx = 0.0f;  ///< [m/s].
  float vy = 0.0f;  ///< [m/s].
  float vz = 0.0f;  ///< [m/s].
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};

}  // namespace particle_surface_tracker

POINT_CLOUD_REGISTER_POINT_STRUCT(particle_surface_tracker::ParticlePoint,
                                  (float, x, x)(float, y, y)(float, z, z)(std::uint32_t, id, id))
POINT_CLOUD_REGISTER_POINT_STRUCT(particle_surface_tracker::MovingParticlePoint,
                                  (float, x, x)(float, y, y)(float, z, z)(std::uint32_t, id,
                                                                          id)(float, vx, vx)(float, vy, vy)(float, vz,
                                                                                                            vz))
