#include "ros/live/mesh_marker.h"

#include <boost/make_shared.hpp>

namespace particle_surface_tracker {
namespace {

visualization_msgs::MarkerPtr begin_marker(const std_msgs::Header& header, std::int32_t action) {
  auto marker = boost::make_shared<visualization_msgs::Marker>();
  marker->header = header;
  marker->ns = "particle_surface_tracker";
  marker->id = 0;
  marker->type = visualization_msgs::Marker::TRIANGLE_LIST;
  marker->action = action;
  return marker;
}

}  // namespace

visualization_msgs::MarkerPtr make_marker(const TrackedMesh& mesh, bool with_colors) {
  const auto marker = begin_marker(mesh.header, visualization_msgs::Marker::ADD);
  marker->pose.orientation.w = 1.0;
  marker->scale.x = marker->scale.y = marker->scale.z = 1.0;
  marker->color.r = 0.25f;
  marker->color.g = 0.55f;
  marker->color.b = 0.85f;
  marker->color.a = 1.0f;
  marker->points.resize(mesh.triangles.size());
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    const float* vertex = &mesh.vertices[3 * std::size_t{mesh.triangles[n]}];
    marker->points[n].x = vertex[0];
    marker->points[n].y = vertex[1];
    marker->points[n].z = vertex[2];
  }
  if (!with_colors || mesh.colors.empty()) return marker;
  marker->colors.resize(mesh.triangles.size());
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    const float* color = &mesh.colors[4 * std::size_t{mesh.triangles[n]}];
    marker->colors[n].r = color[0];
    marker->colors[n].g = color[1];
    marker->colors[n].b = color[2];
    marker->colors[n].a = color[3];
  }
  return marker;
}

visualization_msgs::MarkerPtr make_marker_removal(const std_msgs::Header& header) {
  return begin_marker(header, visualization_msgs::Marker::DELETE);
}

}  // namespace particle_surface_tracker
