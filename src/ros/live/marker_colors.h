#pragma once

#include <vector>

#include <std_msgs/ColorRGBA.h>

#include "ros/live/tracked_view.h"

namespace particle_surface_tracker {

/// What the colours of a marker show.
enum class MarkerColoring {
  kNone,      ///< All one colour, which rviz draws lit.
  kDelta,     ///< δ: blue inside, white at the implicit surface, red outside; full at τ's default, r / 2.
  kVelocity,  ///< Speed of the vertices: blue at rest, yellow for the fastest of the frame.
  kId,        ///< A colour for each id, so that it is seen which vertices live on.
  kCarried    ///< The colours of the first mesh, which are carried along.
};

/// A colour for every vertex; empty where there is nothing to show: with kNone, without velocities, without colours.
std::vector<std_msgs::ColorRGBA> vertex_colors(const TrackedView& view, MarkerColoring coloring);

}  // namespace particle_surface_tracker
