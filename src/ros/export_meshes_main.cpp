// export_meshes: writes the tracked meshes of a bag as a sequence of files.

#include <cstdint>
#include <iostream>
#include <string>

#include <fmt/format.h>
#include <particle_surface_tracker/TrackedMesh.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <CLI/CLI.hpp>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/mesh_sequence.h"
#include "particle_surface_tracker/ros/mesh_conversion.h"
#include "particle_surface_tracker/ros/tracking_bag_writer.h"

namespace {

using namespace particle_surface_tracker;

enum ExitCode { kOk = 0, kUsage = 1, kInput = 2, kOutput = 4 };

struct Options {
  std::string bag;
  std::string topic = TrackingBagWriter::mesh_topic;
  std::string out;
};

TriangleMesh mesh_in(const rosbag::MessageInstance& message) {
  const auto mesh = message.instantiate<TrackedMesh>();
  if (!mesh) {
    throw InputError(fmt::format("it is of type {}, or of another version of {}", message.getDataType(),
                                 ros::message_traits::datatype<TrackedMesh>()));
  }
  return to_triangle_mesh(*mesh);
}

std::uint64_t export_meshes(const Options& options) {
  const rosbag::Bag bag(options.bag);
  rosbag::View view(bag, rosbag::TopicQuery(options.topic));
  if (view.size() == 0) throw InputError(fmt::format("it holds no messages of topic {}", options.topic));
  const MeshSequence sequence(options.out, MeshFormat::kPly);
  std::uint64_t count = 0;
  for (const rosbag::MessageInstance& message : view) {
    try {
      sequence.write(mesh_in(message), count);
    } catch (const OutputError&) {
      throw;
    } catch (const Error& error) {
      throw InputError(fmt::format("message {} of topic {}: {}", count, options.topic, error.what()));
    }
    ++count;
  }
  return count;
}

ExitCode fail(ExitCode code, const std::string& text) {
  std::cerr << "export_meshes: " << text << '\n';
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Writes the tracked meshes of a bag as PLY files, numbered from 0 in the order of the messages.",
               "export_meshes");
  app.add_option("--bag", options.bag, "a recorded bag, or what track_bag --out-bag writes")->required();
  app.add_option("--topic", options.topic, "topic of the meshes")->capture_default_str();
  app.add_option("--out", options.out, "folder for the files; made if it is not there")->required();
  try {
    app.parse(argc, argv);
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
