#pragma once

#include <cstdint>

#include <ros/time.h>

namespace particle_surface_tracker {

/// Any time that a message can carry, exactly; ROS itself refuses nanoseconds beyond a second, which a damaged message
/// has.
inline std::int64_t to_nanoseconds(const ros::Time& time) {
  return static_cast<std::int64_t>(time.sec) * 1000000000 + static_cast<std::int64_t>(time.nsec);
}

/// \param nanoseconds not negative, below 2^32 s.
inline ros::Time to_ros_time(std::int64_t nanoseconds) {
  return ros::Time(static_cast<std::uint32_t>(nanoseconds / 1000000000),
                   static_cast<std::uint32_t>(nanoseconds % 1000000000));
}

}  // namespace particle_surface_tracker
