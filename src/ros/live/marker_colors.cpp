#include "ros/live/marker_colors.h"

#include <algorithm>
#include <cmath>

namespace particle_surface_tracker {
namespace {

using Color = std_msgs::ColorRGBA;

Color color(double red, double green, double blue, double alpha = 1.0) {
  Color result;
  result.r = static_cast<float>(red);
  result.g = static_cast<float>(green);
  result.b = static_cast<float>(blue);
  result.a = static_cast<float>(alpha);
  return result;
}

Color blend(const Color& from, const Color& to, double t) {
  return color(from.r + t * (to.r - from.r), from.g + t * (to.g - from.g), from.b + t * (to.b - from.b));
}

std::vector<Color> by_delta(const TrackedView& view) {
  const Color inside = color(0.1, 0.25, 0.8);
  const Color surface = color(0.95, 0.95, 0.95);
  const Color outside = color(0.8, 0.1, 0.1);
  std::vector<Color> colors;
  colors.reserve(view.mesh->delta.size());
  for (const float delta : view.mesh->delta) {
    const double share = std::clamp(delta / (0.5 * view.r), -1.0, 1.0);
    colors.push_back(blend(surface, share < 0.0 ? inside : outside, std::abs(share)));
  }
  return colors;
}

std::vector<Color> by_velocity(const TrackedView& view) {
  std::vector<double> speeds;
  const std::vector<float>& velocities = view.mesh->velocities;
  for (std::size_t n = 0; n + 2 < velocities.size(); n += 3) {
    speeds.push_back(std::hypot(velocities[n], velocities[n + 1], velocities[n + 2]));
  }
  std::vector<Color> colors;
  if (speeds.empty()) return colors;
  const double fastest = std::max(*std::max_element(speeds.begin(), speeds.end()), 1e-12);
  for (const double speed : speeds) {
    colors.push_back(blend(color(0.1, 0.2, 0.55), color(1.0, 0.85, 0.2), speed / fastest));
  }
  return colors;
}

std::vector<Color> by_id(const TrackedView& view) {
  std::vector<Color> colors;
  colors.reserve(view.mesh->ids.size());
  for (const std::uint32_t id : view.mesh->ids) {
    // Ids next to each other get colours far apart.
    const std::uint32_t mixed = id * 2654435761u;
    colors.push_back(color(0.2 + 0.8 * (mixed >> 24) / 255.0, 0.2 + 0.8 * ((mixed >> 16) & 255) / 255.0,
                           0.2 + 0.8 * ((mixed >> 8) & 255) / 255.0));
  }
  return colors;
}

std::vector<Color> carried(const TrackedView& view) {
  const std::vector<float>& values = view.mesh->colors;
  std::vector<Color> colors;
  for (std::size_t n = 0; n + 3 < values.size(); n += 4) {
    colors.push_back(color(values[n], values[n + 1], values[n + 2], values[n + 3]));
  }
  return colors;
}

}  // namespace

std::vector<Color> vertex_colors(const TrackedView& view, MarkerColoring coloring) {
  switch (coloring) {
    case MarkerColoring::kDelta:
      return by_delta(view);
    case MarkerColoring::kVelocity:
      return by_velocity(view);
    case MarkerColoring::kId:
      return by_id(view);
    case MarkerColoring::kCarried:
      return carried(view);
    case MarkerColoring::kNone:
      break;
  }
  return {};
}

}  // namespace particle_surface_tracker
