#include <memory>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "ros/live/tracker_node.h"
#include "ros/surface/surface_node.h"

namespace particle_surface_tracker {

/// A node inside a nodelet manager.
template <typename Node>
class NodeInManager : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      node_ = std::make_unique<Node>(getNodeHandle(), getPrivateNodeHandle());
    } catch (const std::exception& error) {
      // The manager drops the nodelet and lives on, but says nothing of the reason.
      ROS_FATAL_STREAM(getName() << ": cannot start: " << error.what());
      throw;
    }
  }

  std::unique_ptr<Node> node_;
};

using TrackerNodelet = NodeInManager<TrackerNode>;
using ImplicitSurfaceNodelet = NodeInManager<SurfaceNode>;

}  // namespace particle_surface_tracker

// cppcheck-suppress unknownMacro // It takes two of them in a row for one declaration.
PLUGINLIB_EXPORT_CLASS(particle_surface_tracker::TrackerNodelet, nodelet::Nodelet)
PLUGINLIB_EXPORT_CLASS(particle_surface_tracker::ImplicitSurfaceNodelet, nodelet::Nodelet)
