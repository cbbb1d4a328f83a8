#pragma once

#include <exception>
#include <string>

#include <ros/ros.h>

namespace particle_surface_tracker {

/// A node as a process of its own, until ROS shuts down.
/// \return the exit code.
template <typename Node>
int run_node(int argc, char** argv, const std::string& name) {
  ros::init(argc, argv, name);
  try {
    const Node node(ros::NodeHandle(), ros::NodeHandle("~"));
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(ros::this_node::getName() << ": cannot start: " << error.what());
    return 1;
  }
  return 0;
}

}  // namespace particle_surface_tracker
