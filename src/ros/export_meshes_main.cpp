// export_meshes: writes the tracked meshes of a bag as a sequence of files.

#include <cstdint>
#include <iostream>
#include <limits>
#include <map>
#include <string>

#include <fmt/format.h>
#include <particle_surface_tracker/TrackedMesh.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <CLI/CLI.hpp>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/mesh_sequence.h"
#include "particle_surface_tracker/ros/mesh_conversion.h"
#include "particle_surface_tracker/ros/time_conversion.h"
#include "particle_surface_tracker/ros/tracking_bag_writer.h"

namespace {

using namespace particle_surface_tracker;

enum ExitCode { kOk = 0, kUsage = 1, kInput = 2, kOutput = 4 };

struct Options {
  std::string bag;
  std::string topic = TrackingBagWriter::mesh_topic;
  std::string out;
  MeshFormat format = MeshFormat::kPly;
  std::uint64_t first = 0;
  std::uint64_t last = std::numeric_limits<std::uint64_t>::max();
};

const std::map<std::string, MeshFormat> kFormats{
    {"ply", MeshFormat::kPly}, {"obj", MeshFormat::kObj}, {"vtp", MeshFormat::kVtp}, {"glb", MeshFormat::kGlb}};

TrackedMesh message_in(const rosbag::MessageInstance& instance) {
  const auto message = instance.instantiate<TrackedMesh>();
  if (!message) {
    throw InputError(fmt::format("it is of type {}, or of another version of {}", instance.getDataType(),
                                 ros::message_traits::datatype<TrackedMesh>()));
  }
  return *message;
}

/// \return how many were written.
std::uint64_t export_meshes(const Options& options) {
  const rosbag::Bag bag(options.bag);
  rosbag::View view(bag, rosbag::TopicQuery(options.topic));
  if (view.size() <= options.first) {
    throw InputError(fmt::format("it holds {} messages of topic {}, the first to export is {}", view.size(),
                                 options.topic, options.first));
  }
  MeshSequence sequence(options.out, options.format);
  std::uint64_t count = 0, written = 0;
  for (const rosbag::MessageInstance& instance : view) {
    const std::uint64_t index = count++;
    if (index < options.first || index > options.last) continue;
    try {
      const TrackedMesh message = message_in(instance);
      sequence.write(to_triangle_mesh(message), index, to_nanoseconds(message.header.stamp));
      ++written;
    } catch (const OutputError&) {
      throw;
    } catch (const Error& error) {
      throw InputError(fmt::format("message {} of topic {}: {}", index, options.topic, error.what()));
    }
  }
  return written;
}

ExitCode fail(ExitCode code, const std::string& text) {
  std::cerr << "export_meshes: " << text << '\n';
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Writes the tracked meshes of a bag as files, numbered from 0 in the order of the messages.",
               "export_meshes");
  app.add_option("--bag", options.bag, "a recorded bag, or what track_bag --out-bag writes")->required();
  app.add_option("--topic", options.topic, "topic of the meshes")->capture_default_str();
  app.add_option("--out", options.out, "folder for the files; made if it is not there")->required();
  app.add_option(
         "--format", options.format,
         "ply: all attributes; obj; vtp: all attributes, and a time series frames.pvd for ParaView; glb: binary "
         "glTF 2.0 (default: ply)")
      ->transform(CLI::CheckedTransformer(kFormats).description("ply|obj|vtp|glb"));
  app.add_option("--first", options.first, "first message to export, counted from 0")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--last", options.last, "last message to export (default: all)")->check(CLI::NonNegativeNumber);
  try {
    app.parse(argc, argv);
    if (options.last < options.first) {
      throw CLI::ValidationError("--last", fmt::format("is {}, before --first {}", options.last, options.first));
    }
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kOk : kUsage;
  }
  try {
    std::cout << fmt::format("{}: {} meshes\n", options.out, export_meshes(options));
  } catch (const OutputError& error) {
    return fail(kOutput, error.what());
  } catch (const std::exception& error) {
    return fail(kInput, fmt::format("bag '{}': {}", options.bag, error.what()));
  }
  return kOk;
}
