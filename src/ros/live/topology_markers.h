#pragma once

#include <vector>

#include <visualization_msgs/MarkerArray.h>

#include "ros/live/tracked_view.h"

namespace particle_surface_tracker {

/// Shows where the topology changes: cells that are flagged, cells that were re-meshed since they were shown last, the
/// complex, tangled, deep and front cells of the frame, and a label for every split and merge, which goes after three
/// seconds. Each has a namespace of its own.
class TopologyMarkers {
 public:
  /// Keeps what must not be missed where not every frame is shown.
  void remember(const TrackedView& view);

  /// The markers of a frame, with all that was remembered; that is forgotten.
  visualization_msgs::MarkerArrayPtr show(const TrackedView& view);

  /// Takes all markers away, and forgets.
  visualization_msgs::MarkerArrayPtr remove(const std_msgs::Header& header);

 private:
  std::vector<openvdb::Coord> remeshed_cells_;
  std::vector<TopologyEvent> events_;
  int next_label_ = 0;
};

}  // namespace particle_surface_tracker
