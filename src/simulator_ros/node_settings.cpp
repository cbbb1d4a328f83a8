#include "node_settings.h"

#include <limits>
#include <sstream>

#include <fmt/format.h>
#include <ros/names.h>

#include "particle_surface_tracker/core/error.h"
#include "ros/live/private_parameters.h"

namespace particle_surface_tracker::simulator {
namespace {

constexpr int kMostFrames = 1000000;
constexpr double kLongestTimeout = 1e6;  // [s]

bool read_wall_time(PrivateParameters& source) {
  const std::string time = source.text("time").value_or("simulated");
  if (time == "simulated") return false;
  if (time == "wall") return true;
  throw ParameterError(fmt::format("~time is '{}'; it must be one of: simulated, wall", time));
}

std::vector<std::string> read_node_names(PrivateParameters& source) {
  std::istringstream words(source.text("wait_for").value_or(""));
  std::vector<std::string> names;
  for (std::string word; words >> word;) {
    std::string why;
    if (!ros::names::validate(word, why)) throw ParameterError(fmt::format("~wait_for has '{}': {}", word, why));
    names.push_back(ros::names::resolve(word));
  }
  return names;
}

}  // namespace

NodeSettings read_node_settings(const ros::NodeHandle& private_handle) {
  PrivateParameters source(private_handle);
  NodeSettings settings;
  SimulationSettings& simulation = settings.simulation;
  const double infinity = std::numeric_limits<double>::infinity();
  simulation.frames = static_cast<int>(source.whole("frames", simulation.frames, 1, kMostFrames));
  // The simulator checks these itself, with the ranges of its own table.
  simulation.start_time = source.real("start_time", simulation.start_time, -infinity, infinity);
  for (const auto& [info, field] : simulator_parameter_table()) {
    double& value = simulation.parameters.*field;
    value = source.real(info.name, value, -infinity, infinity);
  }
  simulation.frame_id = source.text("frame_id").value_or(simulation.frame_id);
  settings.mesh_out = source.text("mesh_out").value_or("");
  settings.wall_time = read_wall_time(source);
  settings.wait_for = read_node_names(source);
  settings.max_ahead = static_cast<int>(source.whole("max_ahead", settings.max_ahead, 0, kMostFrames));
  settings.timeout = source.real("timeout", settings.timeout, 0.0, kLongestTimeout);

  const std::vector<std::string> unknown = source.unknown();
  if (!unknown.empty()) throw ParameterError(fmt::format("there is no parameter ~{}", unknown.front()));
  check_simulation_settings(simulation);
  return settings;
}

}  // namespace particle_surface_tracker::simulator
