#include <memory>

#include <nodelet/nodelet.h>
#include <pluginlib/class_list_macros.hpp>

#include "ros/surface/surface_node.h"

namespace particle_surface_tracker {

/// The maker of implicit surfaces inside a nodelet manager.
class ImplicitSurfaceNodelet : public nodelet::Nodelet {
 private:
  void onInit() override {
    try {
      node_ = std::make_unique<SurfaceNode>(getNodeHandle(), getPrivateNodeHandle());
    } catch (const std::exception& error) {
      // The manager drops the nodelet and lives on, but says nothing of the reason.
      ROS_FATAL_STREAM(getName() << ": cannot start: " << error.what());
      throw;
    }
  }

  std::unique_ptr<SurfaceNode> node_;
};

}  // namespace particle_surface_tracker

PLUGINLIB_EXPORT_CLASS(particle_surface_tracker::ImplicitSurfaceNodelet, nodelet::Nodelet)
