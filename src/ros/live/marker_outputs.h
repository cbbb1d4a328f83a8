#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>

#include <ros/ros.h>

#include "ros/live/mesh_marker.h"
#include "ros/live/topology_markers.h"
#include "ros/live/tracked_view.h"

namespace particle_surface_tracker {

/// How often and how markers are published.
struct MarkerOptions {
  double max_rate = 10.0;  ///< [1/s] of wall time.
  MarkerColoring coloring = MarkerColoring::kNone;
};

/// What rviz shows: mesh, implicit surface, and where the topology changes. Markers are made only while somebody
/// subscribes, and not more often than the rate; the last frame of a pause is always shown.
class MarkerOutputs {
 public:
  MarkerOutputs(ros::NodeHandle private_handle, const MarkerOptions& options);
  ~MarkerOutputs();
  MarkerOutputs(const MarkerOutputs&) = delete;
  MarkerOutputs& operator=(const MarkerOutputs&) = delete;

  /// Whether somebody wants to see where the topology changes.
  bool shows_topology() const { return topology_publisher_.getNumSubscribers() > 0; }

  /// Shows a frame, now or when it is due.
  void show(std::shared_ptr<const TrackedView> view);

  /// Takes away all that was shown.
  void clear();

  /// When markers are due that came too soon after the last ones, if there are any.
  std::optional<std::chrono::steady_clock::time_point> due() const;
  void publish_due();

 private:
  bool has_subscribers() const;
  void welcome(const ros::SingleSubscriberPublisher& subscriber, bool to_mesh);

  MarkerOptions options_;
  std::mutex mutex_;  // Of view_.
  std::shared_ptr<const TrackedView> view_;
  TopologyMarkers topology_;
  bool waits_ = false;
  std::chrono::steady_clock::time_point due_{};
  ros::Publisher mesh_publisher_;
  ros::Publisher surface_publisher_;
  ros::Publisher topology_publisher_;
};

}  // namespace particle_surface_tracker
