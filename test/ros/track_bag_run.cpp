#include "track_bag_run.h"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <rosbag/bag.h>

#include "particle_surface_tracker/io/mesh_writer.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "ros_test_support.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test {
namespace {

sensor_msgs::PointCloud2 ball_cloud(int n, double r) {
  static const ParticleFrame ball =
      fill_with_particles(Vec3d(-1, -1, -1), Vec3d(1, 1, 1), r, 0.0, 0, [](const Vec3d& x) { return x.norm() < 0.95; });
  ParticleFrame frame = ball;
  for (Vec3f& position : frame.positions) position.x() += static_cast<float>(n * r / 16);
  frame.stamp_ns = 1000000000000 + n * std::int64_t{10000000};
  return to_point_cloud(frame, "world");
}

}  // namespace

TrackBag::TrackBag() {
  write_ply(folder_ / "ball.ply", make_sphere(Vec3d::Zero(), 1.0, 3));
}

void TrackBag::write_bag(int frames, const std::function<void(int, sensor_msgs::PointCloud2&)>& change) const {
  rosbag::Bag bag(folder_ / "in.bag", rosbag::bagmode::Write);
  bag.setChunkThreshold(20000);  // Two or three clouds.
  for (int n = 0; n < frames; ++n) {
    sensor_msgs::PointCloud2 cloud = ball_cloud(n, r);
    change(n, cloud);
    bag.write("/particles", ros::Time(1000 + n, 0), cloud);
  }
  bag.close();
}

Outcome TrackBag::run(const std::string& arguments, const std::string& before) const {
  std::string command = before + " '" PST_TRACK_BAG "' " + arguments + " >@/stdout 2>@/stderr";
  for (std::size_t at = command.find('@'); at != std::string::npos; at = command.find('@')) {
    command.replace(at, 1, folder_.path().string());
  }
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(folder_ / "stdout"), read_file(folder_ / "stderr")};
}

Outcome TrackBag::run_standard(const std::string& more) const {
  return run("--bag @/in.bag --mesh @/ball.ply --spacing 0.2 --out @/out " + more);
}

std::vector<TrackBag::Json> TrackBag::report() const {
  std::istringstream lines(read_file(folder_ / "report.jsonl"));
  std::vector<Json> objects;
  for (std::string line; std::getline(lines, line);) objects.push_back(Json::parse(line));
  return objects;
}

std::vector<std::string> TrackBag::files_in(const std::string& name) const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / name)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

void expect_error(const Outcome& outcome, int code, const std::vector<std::string>& words) {
  EXPECT_EQ(outcome.code, code) << outcome.err;
  EXPECT_EQ(outcome.err.rfind("track_bag: ", 0), 0u) << outcome.err;
  EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
  for (const std::string& word : words)
    EXPECT_NE(outcome.err.find(word), std::string::npos) << word << "\n" << outcome.err;
}

}  // namespace particle_surface_tracker::test
