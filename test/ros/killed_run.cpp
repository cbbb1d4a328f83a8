#include "killed_run.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <set>
#include <sstream>
#include <stdexcept>
#include <thread>
#include <utility>

#include <nlohmann/json.hpp>

#include "particle_surface_tracker/ros/particle_conversion.h"
#include "ros_test_support.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test {
namespace {

constexpr double r = 0.2;

sensor_msgs::PointCloud2 cloud_of(int n) {
  static const ParticleFrame start = fill_with_particles(
      Vec3d(-1.4, -0.7, -0.7), Vec3d(1.4, 0.7, 0.7), r, 0.2, 3,
      [](const Vec3d& x) { return std::min((x - Vec3d(-0.8, 0, 0)).norm(), (x - Vec3d(0.8, 0.1, 0)).norm()) < 0.6; });
  ParticleFrame frame = start;
  for (Vec3f& x : frame.positions) x.x() += (x.x() < 0.0F ? 0.02F : -0.02F) * static_cast<float>(n);
  frame.stamp_ns = 1000000000 + n * std::int64_t{40000000};
  return to_point_cloud(frame, "world");
}

std::string without_times(const std::string& report) {
  std::istringstream lines(report);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    nlohmann::json json = nlohmann::json::parse(line);
    for (const char* key : {"times", "cpu_times", "cpu_seconds", "peak_rss_bytes"}) json.erase(key);
    kept += json.dump() + "\n";
  }
  return kept;
}

}  // namespace

KilledRun::KilledRun() {
  rosbag::Bag bag(folder_ / "in.bag", rosbag::bagmode::Write);
  for (int n = 0; n < frames; ++n) {
    sensor_msgs::PointCloud2 cloud = cloud_of(n);
    // One that cannot be used: it is skipped, and stays so.
    if (n == 5) cloud.data.pop_back();
    bag.write("/particles", ros::Time(1000 + n, 0), cloud);
  }
  bag.close();
}

int KilledRun::run(const std::string& name, const std::vector<std::string>& more,
                   const std::function<bool()>& kill_now) const {
  const std::string out = folder_ / name;
  std::filesystem::create_directories(out);
  const std::vector<std::pair<std::string, std::string>> standard = {
      {"--bag", folder_ / "in.bag"},  {"--mesh", "implicit"},          {"--spacing", "0.2"},
      {"--out", out + "/out"},        {"--surface", out + "/surface"}, {"--report", out + "/report.jsonl"},
      {"--out-bag", out + "/out.bag"}};
  std::vector<std::string> words = {PST_TRACK_BAG};
  for (const auto& [option, value] : standard) {
    if (std::find(more.begin(), more.end(), option) == more.end()) words.insert(words.end(), {option, value});
  }
  for (std::string word : more) {
    const std::size_t at = word.find('@');
    if (at != std::string::npos) word.replace(at, 1, out);
    words.push_back(word);
  }
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const std::string said = out + "/said.txt";

  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process");
  if (child == 0) {
    const int file = open(said.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
    execv(PST_TRACK_BAG, arguments.data());
    _exit(127);
  }
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    if (kill_now()) kill(child, SIGKILL);
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string KilledRun::output(const std::string& name) const {
  return read_file(folder_ / (name + "/said.txt"));
}

std::map<std::string, std::string> KilledRun::files(const std::string& name) const {
  static const std::set<std::string> kinds = {".ply", ".vtp", ".pvd", ".bag", ".jsonl"};
  std::map<std::string, std::string> found;
  const std::filesystem::path root = folder_ / name;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    const std::string file = entry.path().lexically_relative(root).string();
    const std::string extension = entry.path().extension().string();
    if (!entry.is_regular_file() || kinds.count(extension) == 0) continue;
    const std::string bytes = read_file(entry.path().string());
    found[file] = extension == ".jsonl" ? without_times(bytes) : bytes;
  }
  return found;
}

}  // namespace particle_surface_tracker::test
