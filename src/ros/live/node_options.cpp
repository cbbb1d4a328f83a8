#include "ros/live/node_options.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/mesh_reader.h"
#include "ros/live/private_parameters.h"
#include "ros/live/tracker_parameters.h"

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
  options.mesh_from_topic = path == "topic";
  if (path == "implicit" || options.mesh_from_topic) return;
  LoadedMesh loaded = read_initial_mesh(path);
  for (const std::string& warning : loaded.warnings) {
    options.warnings.push_back(fmt::format("~mesh '{}': {}", path, warning));
  }
  options.handler.mesh = std::move(loaded.mesh);
}

/// One of several named values.
template <typename Value>
Value read_choice(PrivateParameters& source, const std::string& name,
                  const std::vector<std::pair<std::string, Value>>& choices) {
  const std::string wanted = source.text(name).value_or(choices.front().first);
  std::string names;
  for (const auto& [choice, value] : choices) {
    if (wanted == choice) return value;
    names += (names.empty() ? "" : ", ") + choice;
  }
  throw ParameterError(fmt::format("~{} is '{}'; it must be one of: {}", name, wanted, names));
}

/// Names with spaces or commas between them, each once.
std::vector<std::string> read_names(PrivateParameters& source, const std::string& name) {
  std::string text = source.text(name).value_or("");
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream words(text);
  std::vector<std::string> names;
  for (std::string word; words >> word;) {
    if (std::find(names.begin(), names.end(), word) == names.end()) names.push_back(word);
  }
  return names;
}

void read_marker_options(PrivateParameters& source, NodeOptions& options) {
  options.marker.max_rate = source.real("marker_max_rate", 10.0, 0.01, 1000.0);
  options.marker.coloring = read_choice<MarkerColoring>(source, "marker_color_by",
                                                        {{"none", MarkerColoring::kNone},
                                                         {"delta", MarkerColoring::kDelta},
                                                         {"velocity", MarkerColoring::kVelocity},
                                                         {"id", MarkerColoring::kId},
                                                         {"carried", MarkerColoring::kCarried}});
  // It shows what the message has.
  if (options.marker.coloring == MarkerColoring::kVelocity) options.content.velocities = true;
}

void read_checkpoint_options(PrivateParameters& source, CheckpointOptions& options) {
  options.path = source.text("checkpoint").value_or("");
  options.every = static_cast<std::uint64_t>(source.whole("checkpoint_every", 0, 0, 1000000));
  if (options.path.empty()) {
    if (options.every > 0) throw ParameterError("~checkpoint_every needs ~checkpoint, the file to keep");
    return;
  }
  const std::filesystem::path path(options.path);
  std::error_code error;
  if (!path.is_absolute() || !std::filesystem::is_directory(path.parent_path(), error)) {
    throw ParameterError(
        fmt::format("~checkpoint is '{}'; it must be an absolute path in a folder that is there", options.path));
  }
}

}  // namespace

NodeOptions read_node_options(const ros::NodeHandle& private_handle) {
  NodeOptions options;
  PrivateParameters source(private_handle);
  const TrackerParameters tracker = read_tracker_parameters(source, private_handle);
  options.handler.parameters = tracker.wanted;
  options.configured = tracker.configured;
  options.parameter_record = tracker.record;
  options.notes = tracker.notes;
  read_spacing(source, options.handler);
  options.configured.particle_spacing = options.handler.parameters.particle_spacing;
  options.handler.refine_mesh = source.flag("refine_initial", false);
  options.content.normals = source.flag("publish_normals", false);
  options.content.velocities = source.flag("publish_velocities", false);
  options.queue_size = static_cast<std::size_t>(source.whole("queue_size", 50, 1, 1000000));
  options.queue_policy = read_choice<QueuePolicy>(
      source, "queue_policy",
      {{"all", QueuePolicy::kAll}, {"latest", QueuePolicy::kLatest}, {"strict", QueuePolicy::kStrict}});
  options.interpolate = read_names(source, "interpolate");
  options.surfaces.topics = read_names(source, "surfaces");
  options.surfaces.wait = source.real("surface_wait", 0.5, 0.0, 3600.0);
  options.save_folder = source.text("save_folder").value_or("");
  read_checkpoint_options(source, options.checkpoint);
  read_marker_options(source, options);
  options.diagnostics.period = source.real("diagnostic_period", 1.0, 0.1, 3600.0);
  options.diagnostics.late_after = source.real("late_after", 1.0, 0.0, 1e6);
  read_mesh(source, options);
  for (const std::string& name : source.unknown()) {
    options.warnings.push_back(fmt::format("there is no parameter ~{}; it is set in vain", name));
  }
  return options;
}

}  // namespace particle_surface_tracker
