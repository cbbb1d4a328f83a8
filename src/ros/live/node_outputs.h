#pragma once

#include <chrono>
#include <mutex>
#include <optional>

#include <ros/ros.h>

#include <particle_surface_tracker/TrackedMesh.h>
#include <particle_surface_tracker/TrackerStatus.h>

namespace particle_surface_tracker {

/// How often and how the marker is published.
struct MarkerOptions {
  double max_rate = 10.0;  ///< [1/s] of wall time.
  bool colors = false;     ///< Colours of the vertices; rviz draws them unlit.
};

/// The topics of a node. Messages are handed over as pointers and not touched again, so that in one process nothing is
/// copied. Whoever subscribes late gets the last mesh at once.
class NodeOutputs {
 public:
  NodeOutputs(ros::NodeHandle private_handle, const MarkerOptions& marker_options);
  ~NodeOutputs();
  NodeOutputs(const NodeOutputs&) = delete;
  NodeOutputs& operator=(const NodeOutputs&) = delete;

  /// Publishes the mesh and, where somebody looks and it is not too soon after the last one, the marker.
  void publish(TrackedMeshConstPtr mesh);
  void publish(const TrackerStatusConstPtr& status) { status_publisher_.publish(status); }

  /// Takes the last mesh away, from rviz too.
  void clear();

  /// When a marker is due that came too soon after the last one, if there is one.
  std::optional<std::chrono::steady_clock::time_point> marker_due() const;
  void publish_due_marker();

 private:
  void welcome_to_mesh(const ros::SingleSubscriberPublisher& subscriber);
  void welcome_to_marker(const ros::SingleSubscriberPublisher& subscriber);

  MarkerOptions marker_options_;
  std::mutex mutex_;  // Of last_mesh_, and of the order in which a late subscriber sees meshes.
  TrackedMeshConstPtr last_mesh_;
  bool marker_waits_ = false;
  std::chrono::steady_clock::time_point marker_due_{};
  ros::Publisher mesh_publisher_;
  ros::Publisher marker_publisher_;
  ros::Publisher status_publisher_;
};

}  // namespace particle_surface_tracker
