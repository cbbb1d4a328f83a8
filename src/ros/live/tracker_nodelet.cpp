#include <memory>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "ros/live/tracker_node.h"

namespace particle_surface_tracker {

/// The live tracker inside a nodelet manager.
class TrackerNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      node_ = std::make_unique<TrackerNode>(getNodeHandle(), getPrivateNodeHandle());
    } catch (const std::exception& error) {
      // The manager drops the nodelet and lives on, but says nothing of the reason.
      ROS_FATAL_STREAM(getName() << ": cannot start: " << error.what());
      throw;
    }
  }

  std::unique_ptr<TrackerNode> node_;
};

}  // namespace particle_surface_tracker

PLUGINLIB_EXPORT_CLASS(particle_surface_tracker::TrackerNodelet, nodelet::Nodelet)
