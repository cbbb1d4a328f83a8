#pragma once

#include <cstdint>
#include <vector>

#include <sensor_msgs/PointCloud2.h>

namespace particle_surface_tracker {

/// Reads a cloud from the bytes of a message. Lengths inside are checked first: ROS would reserve whatever memory a
/// damaged one asks for.
/// \throw InputError if the bytes are not exactly one message.
sensor_msgs::PointCloud2ConstPtr read_cloud_message(std::vector<std::uint8_t>& bytes);

}  // namespace particle_surface_tracker
