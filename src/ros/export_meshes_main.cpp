// export_meshes: writes the tracked meshes of a bag as a sequence of files.

#include <cstdint>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <particle_surface_tracker/TrackedMesh.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <CLI/CLI.hpp>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/io/gamma_sequence.h"
#include "particle_surface_tracker/io/mesh_reader.h"
#include "particle_surface_tracker/io/mesh_sequence.h"
#include "particle_surface_tracker/ros/mesh_conversion.h"
#include "particle_surface_tracker/ros/time_conversion.h"
#include "particle_surface_tracker/ros/tracking_bag_writer.h"

namespace {

using namespace particle_surface_tracker;

enum ExitCode { kOk = 0, kUsage = 1, kInput = 2, kOutput = 4 };

struct Options {
  std::string bag;
  std::string mesh;  // Instead of a bag.
  std::string topic = TrackingBagWriter::mesh_topic;
  std::string out;
  std::string format = "ply";
  double spacing = 0.0;
  double dx_gamma = Parameters().dx_gamma;
  std::uint64_t first = 0;
  std::uint64_t last = std::numeric_limits<std::uint64_t>::max();
};

constexpr const char* kGamma = "vdb";
const std::map<std::string, std::optional<MeshFormat>> kFormats{{"ply", MeshFormat::kPly},
                                                                {"obj", MeshFormat::kObj},
                                                                {"vtp", MeshFormat::kVtp},
                                                                {"glb", MeshFormat::kGlb},
                                                                {kGamma, std::nullopt}};

/// Writes meshes in the format that was asked for.
class Output {
 public:
  explicit Output(const Options& options) {
    if (const std::optional<MeshFormat> format = kFormats.at(options.format)) {
      meshes_.emplace(options.out, *format);
    } else {
      gamma_.emplace(options.out, options.dx_gamma * options.spacing);
    }
  }

  void write(const TriangleMesh& mesh, std::uint64_t index, std::int64_t stamp_ns) {
    if (meshes_) meshes_->write(mesh, index, stamp_ns);
    if (gamma_) gamma_->write(mesh, index);
    ++count_;
  }

  std::uint64_t count() const { return count_; }

 private:
  std::optional<MeshSequence> meshes_;
  std::optional<GammaSequence> gamma_;
  std::uint64_t count_ = 0;
};

TrackedMesh message_in(const rosbag::MessageInstance& instance) {
  const auto message = instance.instantiate<TrackedMesh>();
  if (!message) {
    throw InputError(fmt::format("it is of type {}, or of another version of {}", instance.getDataType(),
                                 ros::message_traits::datatype<TrackedMesh>()));
  }
  return *message;
}

/// \return how many meshes were written.
std::uint64_t export_bag(const Options& options) {
  const rosbag::Bag bag(options.bag);
  rosbag::View view(bag, rosbag::TopicQuery(options.topic));
  if (view.size() <= options.first) {
    throw InputError(fmt::format("it holds {} messages of topic {}, the first to export is {}", view.size(),
                                 options.topic, options.first));
  }
  Output output(options);
  std::uint64_t count = 0;
  for (const rosbag::MessageInstance& instance : view) {
    const std::uint64_t index = count++;
    if (index < options.first || index > options.last) continue;
    try {
      const TrackedMesh message = message_in(instance);
      output.write(to_mesh_with_fields(message), index, to_nanoseconds(message.header.stamp));
    } catch (const OutputError&) {
      throw;
    } catch (const Error& error) {
      throw InputError(fmt::format("message {} of topic {}: {}", index, options.topic, error.what()));
    }
  }
  return output.count();
}

/// As frame 0.
std::uint64_t export_mesh(const Options& options) {
  const LoadedMesh loaded = read_initial_mesh(options.mesh);
  for (const std::string& warning : loaded.warnings) std::cerr << "export_meshes: warning: " << warning << '\n';
  Output output(options);
  output.write(loaded.mesh, 0, 0);
  return output.count();
}

void add_options(CLI::App& app, Options& options) {
  auto* inputs = app.add_option_group("input");
  inputs->add_option("--bag", options.bag, "a recorded bag, or what track_bag --out-bag writes")->type_name("FILE");
  inputs->add_option("--mesh", options.mesh, "instead: one closed mesh, PLY, OBJ, OFF or STL")->type_name("FILE");
  inputs->require_option(1);
  app.add_option("--topic", options.topic, "topic of the meshes")->capture_default_str();
  app.add_option("--out", options.out, "folder for the files; made if it is not there")->required();
  app.add_option(
         "--format", options.format,
         "ply: all attributes; obj; vtp: all attributes, and a time series frames.pvd for ParaView; glb: binary "
         "glTF 2.0; vdb: gamma, the signed distance to the mesh, as OpenVDB level set (default: ply)")
      ->type_name("ply|obj|vtp|glb|vdb")
      ->check(CLI::IsMember(kFormats).description(""));
  app.add_option("--spacing", options.spacing, "particle spacing r [m], for --format vdb")->check(CLI::PositiveNumber);
  app.add_option("--dx-gamma", options.dx_gamma, "cell size of gamma, in multiples of r")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--first", options.first, "first message to export, counted from 0")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--last", options.last, "last message to export (default: all)")->check(CLI::NonNegativeNumber);
}

void check_options(const Options& options) {
  if (options.last < options.first) {
    throw CLI::ValidationError("--last", fmt::format("is {}, before --first {}", options.last, options.first));
  }
  if (options.format == kGamma && options.spacing == 0.0) {
    throw CLI::ValidationError("--format vdb", "needs --spacing, of which the cells of gamma are multiples");
  }
}

ExitCode fail(ExitCode code, const std::string& text) {
  std::cerr << "export_meshes: " << text << '\n';
  return code;
}

ExitCode run(const Options& options) {
  const bool of_bag = !options.bag.empty();
  try {
    const std::uint64_t count = of_bag ? export_bag(options) : export_mesh(options);
    std::cout << fmt::format("{}: {} meshes\n", options.out, count);
  } catch (const OutputError& error) {
    return fail(kOutput, error.what());
  } catch (const std::exception& error) {
    return fail(kInput, of_bag ? fmt::format("bag '{}': {}", options.bag, error.what())
                               : fmt::format("mesh '{}': {}", options.mesh, error.what()));
  }
  return kOk;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Writes the tracked meshes of a bag as files, numbered from 0 in the order of the messages.",
               "export_meshes");
  add_options(app, options);
  try {
    app.parse(argc, argv);
    check_options(options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kOk : kUsage;
  }
  return run(options);
}
