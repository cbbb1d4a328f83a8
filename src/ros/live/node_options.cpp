#include "ros/live/node_options.h"

#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/mesh_reader.h"
#include "particle_surface_tracker/io/parameter_file.h"
#include "ros/live/private_parameters.h"

namespace particle_surface_tracker {
namespace {

void read_spacing(PrivateParameters& source, FrameHandlerOptions& handler) {
  const std::string spacing = source.text("spacing").value_or("auto");
  handler.estimate_spacing = spacing == "auto";
  if (handler.estimate_spacing) return;
  try {
    set_parameter(handler.parameters, "particle_spacing", spacing);
  } catch (const ParameterError&) {
    throw ParameterError(fmt::format("~spacing is '{}'; it must be a positive number [m], or auto", spacing));
  }
}

void read_mesh(PrivateParameters& source, NodeOptions& options) {
  const std::string path = source.text("mesh").value_or("implicit");
  if (path == "implicit") return;
  LoadedMesh loaded = read_initial_mesh(path);
  for (const std::string& warning : loaded.warnings) {
    options.warnings.push_back(fmt::format("~mesh '{}': {}", path, warning));
  }
  options.handler.mesh = std::move(loaded.mesh);
}

// Those of the tracker itself: from the file first, then one by one.
void read_tracker_parameters(PrivateParameters& source, Parameters& parameters) {
  if (const auto path = source.text("config")) read_parameter_file(*path, parameters);
  for (const ParameterInfo& info : parameter_table()) {
    const auto value = source.text(info.name);
    if (!value) continue;
    if (info.name == "particle_spacing") throw ParameterError("~particle_spacing is set by ~spacing");
    try {
      set_parameter(parameters, info.name, *value);
    } catch (const ParameterError& error) {
      throw ParameterError(fmt::format("~{}", error.what()));
    }
  }
}

QueuePolicy read_queue_policy(PrivateParameters& source) {
  const std::string policy = source.text("queue_policy").value_or("all");
  if (policy == "all") return QueuePolicy::kAll;
  if (policy == "latest") return QueuePolicy::kLatest;
  throw ParameterError(fmt::format("~queue_policy is '{}'; it must be one of: all, latest", policy));
}

}  // namespace

NodeOptions read_node_options(const ros::NodeHandle& private_handle) {
  NodeOptions options;
  PrivateParameters source(private_handle);
  read_tracker_parameters(source, options.handler.parameters);
  read_spacing(source, options.handler);
  options.handler.refine_mesh = source.flag("refine_initial", false);
  options.content.normals = source.flag("publish_normals", false);
  options.content.velocities = source.flag("publish_velocities", false);
  options.queue_size = static_cast<std::size_t>(source.whole("queue_size", 50, 1, 1000000));
  options.queue_policy = read_queue_policy(source);
  options.marker.max_rate = source.real("marker_max_rate", 10.0, 0.01, 1000.0);
  options.marker.colors = source.flag("marker_colors", false);
  read_mesh(source, options);
  for (const std::string& name : source.unknown()) {
    options.warnings.push_back(fmt::format("there is no parameter ~{}; it is set in vain", name));
  }
  return options;
}

}  // namespace particle_surface_tracker
