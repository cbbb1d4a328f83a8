#pragma once

#include <memory>
#include <string>

#include <particle_surface_tracker/CheckpointFile.h>
#include <particle_surface_tracker/SaveMesh.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include "ros/live/initial_mesh_topic.h"
#include "ros/live/node_diagnostics.h"
#include "ros/live/node_options.h"
#include "ros/live/node_outputs.h"
#include "ros/live/parameter_server.h"
#include "ros/live/tracking_worker.h"
#include "ros/surface/surface_topics.h"

namespace particle_surface_tracker {

/// The live tracker, whether it is a node or a nodelet: topics, services and parameters around a TrackingWorker. They
/// are described in docs/node.md.
class TrackerNode {
 public:
  /// \throw ParameterError, InputError, MeshError as read_node_options().
  TrackerNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);
  ~TrackerNode();

 private:
  TrackerNode(ros::NodeHandle handle, ros::NodeHandle private_handle, const NodeOptions& options);

  bool reset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  bool save_mesh(SaveMesh::Request& request, SaveMesh::Response& response);

  bool save_checkpoint(CheckpointFile::Request& request, CheckpointFile::Response& response);
  bool load_checkpoint(CheckpointFile::Request& request, CheckpointFile::Response& response);
  std::string checkpoint_path(const std::string& name) const;

  std::string name_;
  std::string save_folder_;
  std::string checkpoint_;
  NodeOutputs outputs_;
  NodeDiagnostics diagnostics_;
  std::unique_ptr<SurfaceTopics> surfaces_;  // Null: none are joined.
  TrackingWorker worker_;
  ParameterServer parameter_server_;
  ros::ServiceServer reset_service_;
  ros::ServiceServer pause_service_;
  ros::ServiceServer save_mesh_service_;
  ros::ServiceServer save_checkpoint_service_;
  ros::ServiceServer load_checkpoint_service_;
  std::unique_ptr<InitialMeshTopic> initial_mesh_;
  ros::Subscriber particles_;
};

}  // namespace particle_surface_tracker
