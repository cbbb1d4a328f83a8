#pragma once

#include <particle_surface_tracker/TrackedMesh.h>
#include <visualization_msgs/Marker.h>

namespace particle_surface_tracker {

/// The mesh as a TRIANGLE_LIST for rviz, always under the same namespace and id.
/// \param with_colors takes the colours of the vertices, where there are any; rviz draws them unlit.
visualization_msgs::MarkerPtr make_marker(const TrackedMesh& mesh, bool with_colors);

/// Takes the marker away again.
visualization_msgs::MarkerPtr make_marker_removal(const std_msgs::Header& header);

}  // namespace particle_surface_tracker
