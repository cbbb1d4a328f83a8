// make_demo_bag: writes an example to track, a detailed mesh (demo.ply) and particles that a flow moves (demo.bag).

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <rosbag/bag.h>
#include <CLI/CLI.hpp>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/mesh_writer.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "particle_surface_tracker/ros/time_conversion.h"
#include "scaly_ring.h"
#include "twisting_flow.h"

namespace pst = particle_surface_tracker;

namespace {

struct Options {
  std::string out;
  int frames = 60;
  double spacing = 0.03;
};

constexpr double kFramesPerSecond = 60.0;
constexpr std::int64_t kFirstStamp = 1000000000000;  // [ns]
constexpr int kStepsPerFrame = 4;

// Puts the points of a cloud in another order, as simulators do that sort their arrays; ids stay with their points.
void shuffle(sensor_msgs::PointCloud2& cloud, std::mt19937& random) {
  const std::size_t size = cloud.point_step;
  std::vector<std::uint8_t> held(size);
  for (std::size_t last = cloud.width; last > 1; --last) {
    std::uint8_t* a = cloud.data.data() + (random() % last) * size;
    std::uint8_t* b = cloud.data.data() + (last - 1) * size;
    std::memcpy(held.data(), a, size);
    std::memmove(a, b, size);
    std::memcpy(b, held.data(), size);
  }
}

void write_bag(const std::string& path, const pst::ParticleFrame& start, int frames) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  const pst::demo::TwistingFlow flow;
  std::vector<pst::Vec3d> positions;
  for (const pst::Vec3f& position : start.positions) positions.push_back(position.cast<double>());
  std::mt19937 random(1);
  pst::ParticleFrame frame = start;
  for (int index = 0; index < frames; ++index) {
    frame.stamp_ns = kFirstStamp + std::llround(index * 1e9 / kFramesPerSecond);
    for (std::size_t i = 0; i < positions.size(); ++i) frame.positions[i] = positions[i].cast<float>();
    sensor_msgs::PointCloud2 cloud = pst::to_point_cloud(frame, "world");
    cloud.header.seq = static_cast<std::uint32_t>(index);
    cloud.header.stamp = pst::to_ros_time(frame.stamp_ns);
    if (index > 0) shuffle(cloud, random);
    bag.write("/particles", cloud.header.stamp, cloud);

    const double duration = 1.0 / frames;
    for (pst::Vec3d& position : positions) position = flow.follow(position, index * duration, duration, kStepsPerFrame);
  }
  bag.close();
}

void make_demo(const Options& options) {
  std::filesystem::create_directories(options.out);
  const std::string mesh_path = options.out + "/demo.ply";
  const std::string bag_path = options.out + "/demo.bag";
  const pst::demo::ScalyRing ring;
  const pst::TriangleMesh mesh = ring.mesh();
  const pst::ParticleFrame particles = ring.fill(mesh, options.spacing);
  pst::write_ply(mesh_path, mesh);
  write_bag(bag_path, particles, options.frames);
  std::cout << fmt::format("{}: {} triangles\n{}: {} frames of {} particles, r = {} m\n", mesh_path,
                           mesh.triangle_count(), bag_path, options.frames, particles.size(), options.spacing);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app("Writes an example to track: a detailed mesh, demo.ply, and particles that a flow twists, demo.bag.");
  app.add_option("--out", options.out, "folder to write into; made if it is not there")->required();
  app.add_option("--frames", options.frames, "number of frames")->check(CLI::Range(1, 100000))->capture_default_str();
  app.add_option("--spacing", options.spacing, "distance between particles [m]; the ring's tube is 0.4 m thick")
      ->check(CLI::Range(0.005, 0.1))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 1;
  }
  try {
    make_demo(options);
  } catch (const std::exception& error) {
    std::cerr << "make_demo_bag: " << error.what() << '\n';
    return 4;
  }
  return 0;
}
