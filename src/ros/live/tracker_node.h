#pragma once

#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_srvs/Trigger.h>

#include "ros/live/node_options.h"
#include "ros/live/node_outputs.h"
#include "ros/live/parameter_server.h"
#include "ros/live/tracking_worker.h"

namespace particle_surface_tracker {

/// The live tracker, whether it is a node or a nodelet: topics, service and parameters around a TrackingWorker. They
/// are described in docs/node.md.
class TrackerNode {
 public:
  /// \throw ParameterError, InputError, MeshError as read_node_options().
  TrackerNode(ros::NodeHandle handle, const ros::NodeHandle& private_handle);
  ~TrackerNode();

 private:
  TrackerNode(ros::NodeHandle handle, ros::NodeHandle private_handle, const NodeOptions& options);

  bool reset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

  NodeOutputs outputs_;
  TrackingWorker worker_;
  ParameterServer parameter_server_;
  ros::ServiceServer reset_service_;
  ros::Subscriber particles_;
};

}  // namespace particle_surface_tracker
