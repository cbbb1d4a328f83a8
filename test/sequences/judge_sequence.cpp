// Tracks a mesh through a bag and judges the mesh of every frame independently of the tracker.

#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/mesh_reader.h"
#include "sequences/frame_judgement.h"
#include "sequences/judged_tracking.h"
#include "sequences/moving_liquids.h"
#include "sequences/sequence_data.h"
#include "sequences/topology_figures.h"

namespace pst = particle_surface_tracker;

namespace {

struct Options {
  std::string bag;
  std::string topic = "/particles";
  std::string liquid;
  std::string mesh = "implicit";
  pst::Parameters parameters;
  std::vector<std::string> settings;
  std::optional<std::size_t> last;
  std::size_t every = 1;
  std::size_t stride = 1;
  std::string csv;
  bool topology = false;
};

void add_options(CLI::App& app, Options& options) {
  CLI::App& input = *app.add_option_group("input", "one of");
  input.add_option("--bag", options.bag, "Bag of particles");
  input.add_option("--liquid", options.liquid, "A liquid that is made here; it brings its own mesh and spacing")
      ->check(CLI::IsMember(pst::test::moving_liquid_names()));
  input.require_option(1);
  app.add_option("--topic", options.topic, "Topic of the particles");
  app.add_option("--mesh", options.mesh, "Mesh that bounds the liquid of frame 0; 'implicit': that of the particles")
      ->capture_default_str();
  app.add_option("--spacing", options.parameters.particle_spacing, "Particle spacing r [m]");
  app.add_option("--set", options.settings, "A parameter of the tracker, as name=value");
  app.add_option("--last", options.last, "Index of the last frame");
  app.add_option("--every", options.every, "Show the tracker every N-th frame only")->check(CLI::PositiveNumber);
  app.add_option("--stride", options.stride, "Count crossing triangles in every N-th frame (0: never)");
  app.add_option("--csv", options.csv, "File for the figures");
  app.add_flag("--topology", options.topology,
               "Judge splitting and merging instead: topology, nesting, self-intersections, against the limits of the "
               "sequence that the mesh is named after");
}

void apply_settings(Options& options) {
  for (const std::string& setting : options.settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) throw pst::ParameterError("--set " + setting + ": expected name=value");
    pst::set_parameter(options.parameters, setting.substr(0, equals), setting.substr(equals + 1));
  }
}

pst::test::Sequence read_sequence(const Options& options) {
  std::optional<std::size_t> count;
  if (options.last) count = *options.last + 1;
  pst::test::Sequence sequence;
  if (!options.liquid.empty()) {
    sequence = pst::test::make_moving_liquid(options.liquid);
    if (count && *count < sequence.frames.size()) sequence.frames.resize(*count);
    return sequence;
  }
  sequence.spacing = options.parameters.particle_spacing;
  sequence.frames = pst::test::read_particle_bag(options.bag, options.topic, count);
  if (sequence.frames.empty()) throw pst::InputError(options.bag + " holds no frames of " + options.topic);
  sequence.mesh = options.mesh == "implicit" ? pst::test::implicit_mesh(sequence.frames.front(), sequence.spacing)
                                             : pst::read_initial_mesh(options.mesh).mesh;
  return sequence;
}

/// What the limits of a sequence are known by.
std::string name_of(const Options& options) {
  return options.liquid.empty() ? std::filesystem::path(options.mesh).stem().string() : options.liquid;
}

void judge_topology(const Options& options, const pst::test::Sequence& sequence) {
  std::ofstream csv(options.csv);
  csv << pst::test::topology_csv_header() << "\n";
  std::cout << pst::test::topology_header() << std::endl;
  const auto figures = pst::test::track_and_judge(
      sequence, options.parameters, options.every,
      [&](const pst::test::TopologyFigures& frame, const pst::test::TopologyFigures& first) {
        std::cout << pst::test::topology_row(frame, first) << "\n" << pst::test::topology_notes(frame) << std::flush;
        csv << pst::test::topology_csv_row(frame, first) << std::endl;
      });
  const std::string name = name_of(options);
  std::cout << pst::test::summary_of(name, figures, pst::test::limits_for(name)) << std::flush;
}

void judge(const Options& options, const pst::test::Sequence& sequence) {
  const std::vector<pst::ParticleFrame>& frames = sequence.frames;
  std::ofstream csv(options.csv);
  csv << pst::test::judgement_csv_header() << "\n";
  std::cout << pst::test::judgement_header() << std::endl;

  pst::Tracker tracker(options.parameters);
  pst::test::FrameJudgement first;
  for (std::size_t n = 0; n < frames.size(); n += options.every) {
    const pst::FrameReport report = n == 0 ? tracker.start(sequence.mesh, frames[n]) : tracker.advance(frames[n], n);
    for (const std::string& warning : report.warnings) std::cout << "frame " << n << ": " << warning << "\n";
    const bool count_intersections = options.stride != 0 && n % options.stride == 0;
    const auto judgement = pst::test::judge_frame(tracker, frames[n], report, count_intersections);
    if (n == 0) first = judgement;
    std::cout << pst::test::judgement_row(judgement, first) << std::endl;
    csv << pst::test::judgement_csv_row(judgement, first) << std::endl;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Tracks a mesh through a bag and judges every frame independently of the tracker.", "judge_sequence");
  Options options;
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    apply_settings(options);
    const pst::test::Sequence sequence = read_sequence(options);
    options.parameters.particle_spacing = sequence.spacing;
    options.topology ? judge_topology(options, sequence) : judge(options, sequence);
  } catch (const std::exception& error) {
    std::cerr << "judge_sequence: " << error.what() << "\n";
    return 1;
  }
  return 0;
}
