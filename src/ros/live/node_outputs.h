#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>

#include <ros/ros.h>

#include <particle_surface_tracker/TrackedMesh.h>
#include <particle_surface_tracker/TrackerStatus.h>

#include "ros/live/marker_outputs.h"
#include "ros/live/tracked_view.h"

namespace particle_surface_tracker {

/// The topics of a node. Messages are handed over as pointers and not touched again, so that in one process nothing is
/// copied. Whoever subscribes late gets the last mesh at once.
class NodeOutputs {
 public:
  NodeOutputs(ros::NodeHandle private_handle, const MarkerOptions& marker_options);
  ~NodeOutputs();
  NodeOutputs(const NodeOutputs&) = delete;
  NodeOutputs& operator=(const NodeOutputs&) = delete;

  /// Publishes the mesh and, where somebody looks and it is not too soon after the last ones, the markers.
  void publish(std::shared_ptr<const TrackedView> view);
  void publish(const TrackerStatusConstPtr& status) { status_publisher_.publish(status); }

  /// Whether TrackedView::cells of a frame would be shown.
  bool shows_topology() const { return markers_.shows_topology(); }

  /// Takes the last mesh away, from rviz too.
  void clear();

  /// The last mesh of the run, or null; any thread may ask.
  TrackedMeshConstPtr last_mesh() const;

  /// When markers are due that came too soon after the last ones, if there are any.
  std::optional<std::chrono::steady_clock::time_point> markers_due() const { return markers_.due(); }
  void publish_due_markers() { markers_.publish_due(); }

 private:
  void welcome_to_mesh(const ros::SingleSubscriberPublisher& subscriber);

  mutable std::mutex mutex_;  // Of last_mesh_, and of the order in which a late subscriber sees meshes.
  TrackedMeshConstPtr last_mesh_;
  MarkerOutputs markers_;
  ros::Publisher mesh_publisher_;
  ros::Publisher status_publisher_;
};

}  // namespace particle_surface_tracker
