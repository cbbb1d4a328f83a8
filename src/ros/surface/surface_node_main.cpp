#include <ros/ros.h>

#include "ros/surface/surface_node.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "implicit_surface");
  try {
    const particle_surface_tracker::SurfaceNode node(ros::NodeHandle(), ros::NodeHandle("~"));
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL_STREAM(ros::this_node::getName() << ": cannot start: " << error.what());
    return 1;
  }
  return 0;
}
