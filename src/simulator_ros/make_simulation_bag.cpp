// make_simulation_bag: writes what simulator_node publishes, without a roscore: a bag of particles, or the mesh of the
// first frame, or both.

#include <algorithm>
#include <iostream>
#include <string>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/mesh_writer.h"
#include "particle_surface_tracker/ros/tracking_bag_writer.h"
#include "simulation.h"

namespace pst = particle_surface_tracker;

namespace {

enum ExitCode { kOk = 0, kUsage = 1, kSimulation = 3, kOutput = 4 };

struct Options {
  std::string bag;
  std::string mesh_out;
  std::string topic = "/particles";
  bool quiet = false;
  pst::simulator::SimulationSettings settings;
};

// What the simulator checks itself, with its own texts, is not checked here.
void add_options(CLI::App& app, Options& options) {
  CLI::App& outputs = *app.add_option_group("output", "at least one of");
  outputs.add_option("--bag", options.bag, "bag of the particles");
  outputs.add_option("--mesh-out", options.mesh_out, "the mesh of the first frame, PLY");
  outputs.require_option(1, 2);
  app.add_option("--topic", options.topic, "topic of the particles")->capture_default_str();
  app.add_option("--frames", options.settings.frames, "number of frames")->capture_default_str();
  app.add_option("--start-time", options.settings.start_time, "stamp of the first frame [s]")->capture_default_str();
  app.add_option("--frame-id", options.settings.frame_id, "frame of the particles")->capture_default_str();
  app.add_flag("--quiet", options.quiet, "print errors only");
  for (const auto& [info, field] : pst::simulator::simulator_parameter_table()) {
    std::string name = "--" + info.name;
    std::replace(name.begin(), name.end(), '_', '-');
    const std::string unit = info.unit.empty() ? "" : fmt::format(" [{}]", info.unit);
    app.add_option(name, options.settings.parameters.*field, info.text + unit)->capture_default_str();
  }
}

void write_files(const Options& options) {
  pst::simulator::Simulation simulation(options.settings);
  if (!options.mesh_out.empty()) pst::write_ply(options.mesh_out, simulation.scene().mesh);
  if (options.bag.empty()) return;
  pst::TrackingBagWriter bag(options.bag, options.topic);
  do {
    bag.write(simulation.cloud());
    if (!options.quiet && simulation.frame() % 10 == 0) {
      std::cout << fmt::format("frame {} of {}", simulation.frame(), simulation.frame_count()) << std::endl;
    }
  } while (simulation.advance());
  bag.close();
  if (options.quiet) return;
  std::cout << fmt::format("{}: {} frames of {} particles, r = {} m\n", options.bag, options.settings.frames,
                           simulation.scene().particles.size(), options.settings.parameters.spacing);
}

ExitCode fail(ExitCode code, const std::exception& error) {
  std::cerr << "make_simulation_bag: " << error.what() << '\n';
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Simulates a ring of viscous liquid that falls onto a ball, and writes its particles to a bag.",
               "make_simulation_bag");
  add_options(app, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kOk : kUsage;
  }
  try {
    write_files(options);
  } catch (const pst::ParameterError& error) {
    return fail(kUsage, error);
  } catch (const pst::OutputError& error) {
    return fail(kOutput, error);
  } catch (const std::exception& error) {
    return fail(kSimulation, error);
  }
  return kOk;
}
