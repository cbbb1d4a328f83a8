#pragma once

#include <cstdint>
#include <string>

#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>

#include "particle_surface_tracker/core/parameters.h"

namespace particle_surface_tracker {

/// What private parameters of the node set.
struct SurfaceNodeOptions {
  Parameters parameters;
  std::uint32_t queue_size = 50;
  std::uint64_t every = 1;   ///< Makes the surface of one frame in so many,
  std::uint64_t offset = 0;  ///< those whose number leaves this remainder.
};

/// \throw ParameterError that names the parameter, its value and what it should be.
/// \throw InputError if the parameter file cannot be read.
SurfaceNodeOptions read_surface_node_options(const ros::NodeHandle& private_handle);

/// Makes the implicit surfaces of clouds for a tracker in another process: a node without a memory, of which there may
/// be several. Topics and parameters are described in docs/components.md.
class SurfaceNode {
 public:
  /// \throw ParameterError, InputError as read_surface_node_options().
  SurfaceNode(ros::NodeHandle handle, const ros::NodeHandle& private_handle);
  ~SurfaceNode();

 private:
  void receive(const sensor_msgs::PointCloud2ConstPtr& cloud);
  bool is_mine(const std_msgs::Header& header);

  std::string name_;
  SurfaceNodeOptions options_;
  std::uint64_t received_ = 0;
  ros::Publisher surfaces_;
  ros::Subscriber particles_;
};

}  // namespace particle_surface_tracker
