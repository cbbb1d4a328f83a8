#include "tank_markers.h"

namespace particle_surface_tracker::simulator {
namespace {

constexpr double kFloorThickness = 0.02;  // [m]

visualization_msgs::Marker marker(const std::string& frame_id, int id, int type, const Vec3d& center, const Vec3d& size,
                                  float brightness) {
  visualization_msgs::Marker marker;
  marker.header.frame_id = frame_id;
  marker.ns = "tank";
  marker.id = id;
  marker.type = type;
  marker.pose.position.x = center.x();
  marker.pose.position.y = center.y();
  marker.pose.position.z = center.z();
  marker.pose.orientation.w = 1.0;
  marker.scale.x = size.x();
  marker.scale.y = size.y();
  marker.scale.z = size.z();
  marker.color.r = marker.color.g = marker.color.b = brightness;
  marker.color.a = 1.0F;
  return marker;
}

}  // namespace

visualization_msgs::MarkerArray make_tank_markers(const SimulatorParameters& parameters, const std::string& frame_id) {
  using visualization_msgs::Marker;
  visualization_msgs::MarkerArray result;
  const double width = 2.0 * parameters.tank_half_width;
  result.markers.push_back(
      marker(frame_id, 0, Marker::CUBE, {0.0, 0.0, -0.5 * kFloorThickness}, {width, width, kFloorThickness}, 0.75F));
  for (const Sphere& sphere : parameters.obstacles) {
    const int id = static_cast<int>(result.markers.size());
    result.markers.push_back(
        marker(frame_id, id, Marker::SPHERE, sphere.center, Vec3d::Constant(2.0 * sphere.radius), 0.5F));
  }
  return result;
}

}  // namespace particle_surface_tracker::simulator
