#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <ros/node_handle.h>

#include "particle_surface_tracker/ros/frame_handler.h"
#include "ros/live/checkpoint_keeper.h"
#include "ros/live/frame_queue.h"
#include "ros/live/marker_outputs.h"
#include "ros/live/node_diagnostics.h"
#include "ros/live/parameter_record.h"
#include "ros/surface/surface_topics.h"

namespace particle_surface_tracker {

/// Everything that private parameters set.
struct NodeOptions {
  FrameHandlerOptions handler;
  Parameters
      configured;  ///< Those of the handler without what dynamic_reconfigure has changed before the node came up.
  ParameterRecord parameter_record;
  MessageContent content;
  std::size_t queue_size = 50;
  QueuePolicy queue_policy = QueuePolicy::kAll;
  bool mesh_from_topic = false;          ///< The mesh to begin with comes from a topic; frames wait for it.
  std::vector<std::string> interpolate;  ///< Fields of the particles that the mesh is to have.
  std::string save_folder;               ///< Of files that a service is asked to write; empty: none.
  CheckpointOptions checkpoint;
  SurfaceOptions surfaces;
  MarkerOptions marker;
  DiagnosticOptions diagnostics;
  std::vector<std::string> notes;     ///< What became of values that were found, in words.
  std::vector<std::string> warnings;  ///< What a user should know, in words.
};

/// Reads the private parameters of a node, the parameter file and the mesh that they name.
/// \throw ParameterError that names the parameter, its value and what it should be.
/// \throw InputError, MeshError if a file cannot be read or used.
NodeOptions read_node_options(const ros::NodeHandle& private_handle);

}  // namespace particle_surface_tracker
