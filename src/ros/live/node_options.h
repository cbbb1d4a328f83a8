#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <ros/node_handle.h>

#include "particle_surface_tracker/ros/frame_handler.h"
#include "ros/live/frame_queue.h"
#include "ros/live/node_outputs.h"

namespace particle_surface_tracker {

/// Everything that private parameters set.
struct NodeOptions {
  FrameHandlerOptions handler;
  MessageContent content;
  std::size_t queue_size = 50;
  QueuePolicy queue_policy = QueuePolicy::kAll;
  MarkerOptions marker;
  std::vector<std::string> warnings;  ///< What a user should know, in words.
};

/// Reads the private parameters of a node, the parameter file and the mesh that they name.
/// \throw ParameterError that names the parameter, its value and what it should be.
/// \throw InputError, MeshError if a file cannot be read or used.
NodeOptions read_node_options(const ros::NodeHandle& private_handle);

}  // namespace particle_surface_tracker
