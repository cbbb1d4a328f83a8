#include "ros/live/mesh_marker.h"

#include <boost/make_shared.hpp>

namespace particle_surface_tracker {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerPtr;

constexpr const char* kMesh = "mesh";
constexpr const char* kSurface = "implicit_surface";

MarkerPtr make_removal(const std_msgs::Header& header, const char* name) {
  auto marker = boost::make_shared<Marker>();
  marker->header = header;
  marker->ns = name;
  marker->type = Marker::TRIANGLE_LIST;
  marker->action = Marker::DELETE;
  return marker;
}

MarkerPtr begin_marker(const std_msgs::Header& header, const char* name, float red, float green, float blue,
                       float alpha) {
  MarkerPtr marker = make_removal(header, name);
  marker->action = Marker::ADD;
  marker->pose.orientation.w = 1.0;
  marker->scale.x = marker->scale.y = marker->scale.z = 1.0;
  marker->color.r = red;
  marker->color.g = green;
  marker->color.b = blue;
  marker->color.a = alpha;
  return marker;
}

void add_point(Marker& marker, const float* place) {
  geometry_msgs::Point point;
  point.x = place[0];
  point.y = place[1];
  point.z = place[2];
  marker.points.push_back(point);
}

}  // namespace

MarkerPtr make_mesh_marker(const TrackedView& view, MarkerColoring coloring) {
  const TrackedMesh& mesh = *view.mesh;
  MarkerPtr marker = begin_marker(mesh.header, kMesh, 0.25f, 0.55f, 0.85f, 1.0f);
  marker->points.reserve(mesh.triangles.size());
  for (const std::uint32_t vertex : mesh.triangles) add_point(*marker, &mesh.vertices[3 * std::size_t{vertex}]);
  const std::vector<std_msgs::ColorRGBA> colors = vertex_colors(view, coloring);
  if (colors.empty()) return marker;
  marker->colors.reserve(mesh.triangles.size());
  for (const std::uint32_t vertex : mesh.triangles) marker->colors.push_back(colors[vertex]);
  return marker;
}

MarkerPtr make_surface_marker(const TrackedView& view) {
  if (view.surface == nullptr) return make_surface_marker_removal(view.mesh->header);
  MarkerPtr marker = begin_marker(view.mesh->header, kSurface, 0.9f, 0.6f, 0.2f, 0.4f);
  const SurfaceTriangulation& surface = view.surface->triangulation;
  marker->points.reserve(3 * surface.triangles.size());
  for (const Triangle& triangle : surface.triangles) {
    for (const std::uint32_t vertex : triangle) add_point(*marker, surface.vertices[vertex].data());
  }
  return marker;
}

MarkerPtr make_mesh_marker_removal(const std_msgs::Header& header) {
  return make_removal(header, kMesh);
}

MarkerPtr make_surface_marker_removal(const std_msgs::Header& header) {
  return make_removal(header, kSurface);
}

}  // namespace particle_surface_tracker
