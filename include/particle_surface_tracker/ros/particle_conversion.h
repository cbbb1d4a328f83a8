#pragma once

#include <string>

#include <sensor_msgs/PointCloud2.h>

#include "particle_surface_tracker/core/particle_frame.h"

namespace particle_surface_tracker {

/// Reads particles from a cloud: fields x y z (FLOAT32, [m]) and id (UINT32), and vx vy vz (FLOAT32, [m/s]) where all
/// three are there. Other fields are passed over. Organised clouds and rows with padding are welcome; a cloud without
/// points is an empty frame.
/// \throw InputError if the cloud's description does not hold together; it names field, value found and value wanted.
/// \throw ParticleError as make_particle_frame().
ParticleFrame to_particle_frame(const sensor_msgs::PointCloud2& cloud);

/// Checks that to_particle_frame() can read a cloud, without looking at the particles.
/// \throw InputError as to_particle_frame().
void check_particle_cloud(const sensor_msgs::PointCloud2& cloud);

/// Makes a cloud that to_particle_frame() reads back exactly; velocities only where the frame has them.
sensor_msgs::PointCloud2 to_point_cloud(const ParticleFrame& frame, const std::string& frame_id);

}  // namespace particle_surface_tracker
