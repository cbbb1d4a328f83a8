#pragma once

#include <vector>

#include <std_msgs/Header.h>
#include <visualization_msgs/Marker.h>

#include "ros/live/marker_colors.h"
#include "ros/live/tracked_view.h"

namespace particle_surface_tracker {

/// The mesh as a TRIANGLE_LIST for rviz, always under the same namespace and id. With colours it is drawn unlit.
visualization_msgs::MarkerPtr make_mesh_marker(const TrackedView& view, MarkerColoring coloring);

/// φ = 0 as a transparent TRIANGLE_LIST, always under the same namespace and id.
visualization_msgs::MarkerPtr make_surface_marker(const TrackedView& view);

/// Takes these markers away again.
visualization_msgs::MarkerPtr make_mesh_marker_removal(const std_msgs::Header& header);
visualization_msgs::MarkerPtr make_surface_marker_removal(const std_msgs::Header& header);

}  // namespace particle_surface_tracker
