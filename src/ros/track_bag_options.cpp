#include "track_bag_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/parameter_file.h"

namespace particle_surface_tracker {
namespace {

// Options that are more than a value to store.
struct RawOptions {
  std::string mesh;
  std::string spacing;
  std::string format = "ply";
  std::string config;
  std::string debug_cells;
  std::vector<std::string> settings;
  std::optional<std::uint64_t> checkpoint_every;
};

const std::map<std::string, std::optional<MeshFormat>> formats = {{"ply", MeshFormat::kPly},
                                                                  {"obj", MeshFormat::kObj},
                                                                  {"vtp", MeshFormat::kVtp},
                                                                  {"glb", MeshFormat::kGlb},
                                                                  {"none", std::nullopt}};

void add_inputs(CLI::App& app, OfflineOptions& options, RawOptions& raw) {
  app.add_option("--bag", options.bag, "Bag with the particles: sensor_msgs/PointCloud2 with x y z [m] and id")
      ->required()
      ->type_name("FILE");
  app.add_option("--topic", options.topic, "Topic of the particles")->type_name("TOPIC")->capture_default_str();
  app.add_option("--mesh", raw.mesh,
                 "Closed mesh [m] that bounds the liquid of frame --first: PLY, OBJ, OFF or STL; "
                 "'implicit' starts from the implicit surface of that frame")
      ->required()
      ->type_name("FILE|implicit");
  app.add_option("--spacing", raw.spacing,
                 "Particle spacing r: distance between neighbouring particles at rest [m]; "
                 "'auto' estimates it from frame --first")
      ->required()
      ->type_name("R|auto");
  app.add_flag("--refine-initial", options.refine_initial, "Split edges of the mesh that are longer than r");
  app.add_option("--first", options.first, "First frame, counted from 0")->type_name("N")->capture_default_str();
  app.add_option("--last", options.last, "Last frame; without it the last one of the bag")->type_name("N");
}

void add_parameters(CLI::App& app, OfflineOptions& options, RawOptions& raw) {
  app.add_option("--config", raw.config, "YAML file of parameters")->type_name("FILE.yaml");
  app.add_option("--set", raw.settings, "Sets one parameter, after --config; may be given several times")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  app.add_option("--threads", options.threads, "Use at most so many threads; without it all there are")
      ->type_name("N")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1024}));
  app.add_flag("--pipeline", options.pipeline,
               "Make the implicit surface of a frame on a thread of its own, while the frame before is tracked");
}

void add_checkpoints(CLI::App& app, OfflineOptions& options, RawOptions& raw) {
  app.add_option("--checkpoint", options.checkpoint,
                 "File that keeps all that is needed to go on, should the run end early")
      ->type_name("FILE");
  app.add_option("--checkpoint-every", raw.checkpoint_every, "Frames from one checkpoint to the next")
      ->type_name("N")
      ->default_str("10")
      ->check(CLI::PositiveNumber);
  app.add_option("--resume", options.resume,
                 "Go on from this checkpoint, with the other options as they were; --mesh is not read again. "
                 "Checkpoints are kept in this file unless --checkpoint names another")
      ->type_name("FILE");
}

void add_check(CLI::App& app, OfflineOptions& options) {
  app.add_flag("--check", options.check,
               "Check the mesh of every frame: one that is not closed, manifold and oriented ends the run; "
               "self-intersecting triangles are reported");
}

void add_outputs(CLI::App& app, OfflineOptions& options, RawOptions& raw) {
  app.add_option("--out", options.out, "Folder of the tracked meshes, frame_000000.ply and so on; made if missing")
      ->required()
      ->type_name("DIR");
  app.add_option("--format", raw.format, "Format of the meshes; with vtp also their time series, frames.pvd")
      ->type_name("ply|obj|vtp|glb|none")
      ->capture_default_str()
      ->check(CLI::IsMember(formats).description(""));
  app.add_option("--interpolate", options.interpolate,
                 "Fields of the particles that bag and mesh files are to have at the vertices: velocity (of vx vy vz), "
                 "rgb, rgba, or the name of a scalar field")
      ->type_name("FIELD...")
      ->delimiter(',');
  app.add_option("--surface", options.surface, "Folder for the implicit surface of every frame, as PLY")
      ->type_name("DIR");
  app.add_option("--vdb", options.vdb, "Folder for the implicit function phi of every frame, as OpenVDB level set")
      ->type_name("DIR");
  app.add_option("--debug-cells", raw.debug_cells,
                 "Write what re-meshing did in some frames (3,10-20) or all into --out: flagged, complex, marked ... "
                 "cells and psi, as OpenVDB and VTP")
      ->type_name("FRAMES|all");
  app.add_option("--out-bag", options.out_bag, "Bag of the particles and, in /tracked_mesh, the tracked meshes")
      ->type_name("FILE");
  app.add_option("--report", options.report, "File with one JSON object per frame and line")->type_name("FILE.jsonl");
  app.add_flag("--quiet", options.quiet, "Print errors only");
}

std::string list_of_parameters() {
  std::string list = "Parameters for --config and --set (r: particle spacing; defaults in brackets):\n";
  const Parameters defaults;
  for (const ParameterInfo& info : parameter_table()) {
    if (info.name == "particle_spacing") continue;  // That is --spacing.
    const std::string unit = info.unit.empty() ? "" : " " + info.unit;
    list += fmt::format("  {:<24} {} [{}{}]\n", info.name, info.text, get_parameter(defaults, info.name), unit);
  }
  return list + "\nExit codes: 0 ok, 1 usage, 2 input, 3 tracking, 4 output, 130 interrupted.";
}

void apply_setting(const std::string& setting, Parameters& parameters) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos) {
    throw ParameterError(fmt::format("--set {}: expected a name, '=' and a value", setting));
  }
  set_parameter(parameters, setting.substr(0, equals), setting.substr(equals + 1));
}

double read_spacing(const std::string& text) {
  std::size_t used = 0;
  double spacing = 0.0;
  try {
    spacing = std::stod(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !std::isfinite(spacing) || spacing <= 0.0) {
    throw ParameterError(fmt::format("--spacing {}: expected a positive number [m], or auto", text));
  }
  return spacing;
}

std::uint64_t read_frame(const std::string& text, const std::string& all) {
  std::uint64_t frame = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), frame);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw ParameterError(
        fmt::format("--debug-cells {}: '{}' is no frame; expected for instance 3,10-20, or all", all, text));
  }
  return frame;
}

std::vector<std::pair<std::uint64_t, std::uint64_t>> read_frames(const std::string& text) {
  if (text == "all") return {{0, std::numeric_limits<std::uint64_t>::max()}};
  std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string part = text.substr(begin, end - begin);
    const std::size_t dash = part.find('-');
    const std::uint64_t first = read_frame(part.substr(0, dash), text);
    const std::uint64_t last = dash == std::string::npos ? first : read_frame(part.substr(dash + 1), text);
    if (last < first)
      throw ParameterError(fmt::format("--debug-cells {}: frame {} comes before {}", text, last, first));
    ranges.emplace_back(first, last);
    begin = end + 1;
  }
  return ranges;
}

std::vector<std::string> each_once(const std::vector<std::string>& names) {
  std::vector<std::string> result;
  for (const std::string& name : names) {
    if (name.empty()) throw ParameterError("--interpolate: a field without a name");
    if (std::find(result.begin(), result.end(), name) == result.end()) result.push_back(name);
  }
  return result;
}

void resolve(const RawOptions& raw, OfflineOptions& options) {
  options.interpolate = each_once(options.interpolate);
  if (raw.mesh != "implicit") options.mesh = raw.mesh;
  options.format = formats.at(raw.format);
  if (!raw.config.empty()) read_parameter_file(raw.config, options.parameters);
  for (const std::string& setting : raw.settings) apply_setting(setting, options.parameters);
  if (!raw.debug_cells.empty()) options.debug_cells = read_frames(raw.debug_cells);
  options.estimate_spacing = raw.spacing == "auto";
  if (options.checkpoint.empty()) options.checkpoint = options.resume;
  if (raw.checkpoint_every && options.checkpoint.empty()) {
    throw ParameterError("--checkpoint-every needs --checkpoint or --resume");
  }
  options.checkpoint_every = raw.checkpoint_every.value_or(options.checkpoint_every);
  if (!options.estimate_spacing) options.parameters.particle_spacing = read_spacing(raw.spacing);
}

}  // namespace

CommandLine read_command_line(int argc, const char* const* argv) {
  CLI::App app("Tracks a detailed mesh through the particle frames of a bag.", "track_bag");
  OfflineOptions options;
  RawOptions raw;
  app.set_version_flag("--version", "track_bag " PST_VERSION);
  add_inputs(app, options, raw);
  add_parameters(app, options, raw);
  add_checkpoints(app, options, raw);
  add_check(app, options);
  add_outputs(app, options, raw);
  app.footer(list_of_parameters);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return {std::nullopt, app.help()};
  } catch (const CLI::CallForVersion& version) {
    return {std::nullopt, version.what() + std::string("\n")};
  } catch (const CLI::ParseError& error) {
    throw ParameterError(fmt::format("{}; see track_bag --help", error.what()));
  }
  resolve(raw, options);
  return {options, ""};
}

}  // namespace particle_surface_tracker
