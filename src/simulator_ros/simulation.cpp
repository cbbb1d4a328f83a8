#include "simulation.h"

#include <cmath>

#include <fmt/format.h>
#include <boost/make_shared.hpp>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "particle_surface_tracker/ros/time_conversion.h"

namespace particle_surface_tracker::simulator {
namespace {

// ROS counts seconds in 32 bits; what is left out leaves room for the frames.
constexpr double kLatestStart = 4e9;
constexpr double kEarliestStart = 1e-3;

const SimulationSettings& checked(const SimulationSettings& settings) {
  check_simulation_settings(settings);
  return settings;
}

Scene scene_at(const SimulationSettings& settings) {
  Scene scene = falling_ring(settings.parameters);
  scene.particles.stamp_ns = std::llround(settings.start_time * 1e9);
  return scene;
}

}  // namespace

void check_simulation_settings(const SimulationSettings& settings) {
  if (settings.frames < 1) throw ParameterError(fmt::format("frames is {}; it must be at least 1", settings.frames));
  // Negated, so that a NaN fails it too. A bag takes no stamp of 0, and to ROS it means that there is no time yet.
  if (!(settings.start_time >= kEarliestStart && settings.start_time <= kLatestStart)) {
    throw ParameterError(
        fmt::format("start_time is {} s; it must lie in [{}, {}]", settings.start_time, kEarliestStart, kLatestStart));
  }
  if (settings.frame_id.empty()) throw ParameterError("frame_id is empty; it must name a frame, for instance world");
}

Simulation::Simulation(const SimulationSettings& settings)
    : frame_count_(checked(settings).frames),
      frame_id_(settings.frame_id),
      scene_(scene_at(settings)),
      simulator_(scene_.parameters, scene_.particles) {}

sensor_msgs::PointCloud2Ptr Simulation::cloud() const {
  const ParticleFrame& particles = simulator_.frame();
  auto cloud = boost::make_shared<sensor_msgs::PointCloud2>(to_point_cloud(particles, frame_id_));
  cloud->header.stamp = to_ros_time(particles.stamp_ns);
  cloud->header.seq = static_cast<std::uint32_t>(frame_);
  return cloud;
}

bool Simulation::advance() {
  if (frame_ + 1 >= frame_count_) return false;
  simulator_.step();
  ++frame_;
  return true;
}

}  // namespace particle_surface_tracker::simulator
