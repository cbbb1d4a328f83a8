// Runs the program track_bag itself: exit codes, files, messages.

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <rosbag/view.h>
#include <nlohmann/json.hpp>

#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/io/mesh_reader.h"
#include "particle_surface_tracker/io/mesh_writer.h"
#include "particle_surface_tracker/io/parameter_file.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "ros_test_support.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test {
namespace {

constexpr double r = 0.2;

using Json = nlohmann::json;

// The cloud of frame n: a ball of liquid of radius 1 that moves by r / 16 along x in every frame.
sensor_msgs::PointCloud2 ball_cloud(int n) {
  static const ParticleFrame ball =
      fill_with_particles(Vec3d(-1, -1, -1), Vec3d(1, 1, 1), r, 0.0, 0, [](const Vec3d& x) { return x.norm() < 0.95; });
  ParticleFrame frame = ball;
  for (Vec3f& position : frame.positions) position.x() += static_cast<float>(n * r / 16);
  frame.stamp_ns = 1000000000000 + n * std::int64_t{10000000};
  return to_point_cloud(frame, "world");
}

struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

class TrackBag : public testing::Test {
 protected:
  TrackBag() { write_ply(folder_ / "ball.ply", make_sphere(Vec3d::Zero(), 1.0, 3)); }

  // Writes a bag of the clouds 0 … frames − 1, each as `change` leaves it.
  template <typename Change>
  void write_bag(int frames, Change&& change) {
    rosbag::Bag bag(folder_ / "in.bag", rosbag::bagmode::Write);
    bag.setChunkThreshold(20000);  // Two or three clouds.
    for (int n = 0; n < frames; ++n) {
      sensor_msgs::PointCloud2 cloud = ball_cloud(n);
      change(n, cloud);
      bag.write("/particles", ros::Time(1000 + n, 0), cloud);
    }
    bag.close();
  }

  void write_bag(int frames) {
    write_bag(frames, [](int, sensor_msgs::PointCloud2&) {});
  }

  // Runs with these arguments; @ stands for the folder.
  Outcome run(const std::string& arguments, const std::string& before = "") {
    std::string command = before + " '" PST_TRACK_BAG "' " + arguments + " >@/stdout 2>@/stderr";
    for (std::size_t at = command.find('@'); at != std::string::npos; at = command.find('@')) {
      command.replace(at, 1, folder_.path().string());
    }
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(folder_ / "stdout"), read_file(folder_ / "stderr")};
  }

  Outcome run_standard(const std::string& more = "") {
    return run("--bag @/in.bag --mesh @/ball.ply --spacing 0.2 --out @/out " + more);
  }

  // One line on the error stream that begins with the program's name and has all the words.
  static void expect_error(const Outcome& outcome, int code, const std::vector<std::string>& words) {
    EXPECT_EQ(outcome.code, code) << outcome.err;
    EXPECT_EQ(outcome.err.rfind("track_bag: ", 0), 0u) << outcome.err;
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
    for (const std::string& word : words)
      EXPECT_NE(outcome.err.find(word), std::string::npos) << word << "\n" << outcome.err;
  }

  std::vector<Json> report() const {
    std::istringstream lines(read_file(folder_ / "report.jsonl"));
    std::vector<Json> objects;
    for (std::string line; std::getline(lines, line);) objects.push_back(Json::parse(line));
    return objects;
  }

  std::vector<std::string> files_in(const std::string& name) const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / name)) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  TemporaryFolder folder_;
};

TEST_F(TrackBag, TracksEveryFrameAndWritesEverything) {
  write_bag(4);
  const Outcome outcome = run_standard("--report @/report.jsonl --out-bag @/out.bag --surface @/surface --threads 1");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("4 frames tracked"), std::string::npos) << outcome.out;
  const std::vector<std::string> names = {"frame_000000.ply", "frame_000001.ply", "frame_000002.ply",
                                          "frame_000003.ply"};
  EXPECT_EQ(files_in("out"), names);
  EXPECT_EQ(files_in("surface"), names);
  EXPECT_EQ(read_initial_mesh(folder_ / "out/frame_000000.ply").mesh.positions(),
            read_initial_mesh(folder_ / "ball.ply").mesh.positions());
  ASSERT_EQ(report().size(), 4u);
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_EQ(report()[n]["frame"], n);
    EXPECT_GT(report()[n]["times"]["total"].get<double>(), 0.0) << n;
    EXPECT_GT(report()[n]["peak_rss_bytes"].get<double>(), 1e6) << n;
  }
  EXPECT_EQ(report()[2]["stamp"].get<double>(), 1000.02);
  rosbag::Bag bag(folder_ / "out.bag");
  EXPECT_EQ(rosbag::View(bag, rosbag::TopicQuery("/particles")).size(), 4u);
  EXPECT_EQ(rosbag::View(bag, rosbag::TypeQuery("particle_surface_tracker/TrackedMesh")).size(), 4u);
}

TEST_F(TrackBag, ChecksEveryFrameIfAsked) {
  write_bag(3);
  // A second ball crosses the first.
  write_ply(folder_ / "ball.ply",
            joined({make_sphere(Vec3d::Zero(), 1.0, 3), make_sphere(Vec3d(0.05, 0.02, 0.01), 0.95, 3)}));
  const Outcome outcome = run_standard("--check --set topology=keep --report @/report.jsonl");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("checking"), std::string::npos) << outcome.out;
  ASSERT_EQ(report().size(), 3u);
  for (const Json& line : report()) {
    EXPECT_GT(line["self_intersecting_triangles"], 0.0);
    EXPECT_LE(line["self_intersecting_triangles"], 1.0);
  }
}

TEST_F(TrackBag, WritesCellsOfTheFramesThatAreAskedForAndNothingElseChanges) {
  write_bag(4);
  // A second ball crosses the first, so that there is something to re-mesh.
  write_ply(folder_ / "ball.ply",
            joined({make_sphere(Vec3d::Zero(), 1.0, 3), make_sphere(Vec3d(0.05, 0.02, 0.01), 0.95, 3)}));
  ASSERT_EQ(run_standard("--quiet --debug-cells 1,3-7 --report @/report.jsonl").code, 0);
  std::vector<std::string> cells, meshes;
  for (const std::string& name : files_in("out")) (name.rfind("cells_", 0) == 0 ? cells : meshes).push_back(name);
  EXPECT_EQ(cells,
            (std::vector<std::string>{"cells_000001.vdb", "cells_000001.vtp", "cells_000003.vdb", "cells_000003.vtp"}));
  openvdb::initialize();
  openvdb::io::File file(folder_ / "out/cells_000001.vdb");
  file.open();
  EXPECT_EQ(file.readGrid("marked")->activeVoxelCount(), report()[1]["topology"]["remeshed_cells"]);
  EXPECT_GT(file.readGrid("tangled")->activeVoxelCount(), 0u);

  ASSERT_EQ(run("--bag @/in.bag --mesh @/ball.ply --spacing 0.2 --out @/plain --quiet").code, 0);
  EXPECT_EQ(files_in("plain"), meshes);
  for (const std::string& name : meshes) {
    EXPECT_EQ(read_file(folder_ / ("plain/" + name)), read_file(folder_ / ("out/" + name))) << name;
  }
  expect_error(run_standard("--debug-cells 1,x"), 1, {"--debug-cells 1,x", "'x'"});
  expect_error(run_standard("--debug-cells 5-3"), 1, {"--debug-cells", "3", "5"});
}

TEST_F(TrackBag, RangeOfFramesKeepsTheirNumbers) {
  write_bag(6);
  write_ply(folder_ / "ball.ply", make_sphere(Vec3d(2 * r / 16, 0, 0), 1.0, 3));
  ASSERT_EQ(run_standard("--first 2 --last 4 --format obj --quiet --report @/report.jsonl").code, 0);
  EXPECT_EQ(files_in("out"), (std::vector<std::string>{"frame_000002.obj", "frame_000003.obj", "frame_000004.obj"}));
  EXPECT_EQ(report().front()["frame"], 2);
}

TEST_F(TrackBag, ImplicitMeshAndEstimatedSpacing) {
  write_bag(3);
  const Outcome outcome = run("--bag @/in.bag --mesh implicit --spacing auto --out @/out --format none");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("estimated"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("0.2 m"), std::string::npos) << outcome.out;
}

TEST_F(TrackBag, SettingsAreAppliedAfterTheFile) {
  write_bag(1);
  write_file(folder_ / "p.yaml", "epsilon: 7\n");
  expect_error(run_standard("--config @/p.yaml"), 1, {"p.yaml", "line 1", "epsilon", "7"});
  write_file(folder_ / "p.yaml", "epsilon: 0.5\n");
  EXPECT_EQ(run_standard("--config @/p.yaml --set tau=0.4 --set advection=average").code, 0);
  expect_error(run_standard("--config @/p.yaml --set epsilon=9"), 1, {"epsilon", "9"});
  expect_error(run_standard("--config @/missing.yaml"), 2, {"missing.yaml"});
}

TEST_F(TrackBag, UsageErrors) {
  write_bag(3);
  expect_error(run(""), 1, {"--help"});
  expect_error(run("--bag @/in.bag --mesh implicit --out @/out"), 1, {"--spacing"});
  expect_error(run_standard("--nonsense"), 1, {"--nonsense"});
  expect_error(run_standard("stray"), 1, {"stray"});
  expect_error(run_standard("--format stl"), 1, {"--format", "stl"});
  expect_error(run_standard("--threads 0"), 1, {"--threads"});
  expect_error(run_standard("--first -1"), 1, {"--first"});
  expect_error(run_standard("--first 3"), 1, {"--first 3", "3 frames, 0 to 2"});
  expect_error(run_standard("--last 3"), 1, {"--last 3", "3 frames, 0 to 2"});
  expect_error(run_standard("--first 2 --last 1"), 1, {"--last 1", "--first 2"});
  expect_error(run_standard("--set tau"), 1, {"--set tau"});
  expect_error(run_standard("--set taau=1"), 1, {"taau"});
  expect_error(run_standard("--set tau=nan"), 1, {"tau", "nan"});
  expect_error(run_standard("--out-bag @/in.bag"), 1, {"same file"});
  for (const char* spacing : {"0", "-1", "nan", "inf", "abc", "1m", "''", "1e999"}) {
    expect_error(run(std::string("--bag @/in.bag --mesh implicit --out @/out --spacing ") + spacing), 1, {"--spacing"});
  }
}

TEST_F(TrackBag, HelpAndVersion) {
  const Outcome help = run("--help");
  EXPECT_EQ(help.code, 0);
  for (const char* word : {"--bag", "--spacing", "[m]", "--refine-initial", "tau", "130 interrupted"}) {
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  }
  EXPECT_EQ(run("--version").code, 0);
  EXPECT_EQ(run("--version").out.rfind("track_bag ", 0), 0u);
}

TEST_F(TrackBag, InputErrors) {
  expect_error(run_standard(), 2, {"in.bag", "No such file"});
  write_file(folder_ / "in.bag", "no bag");
  expect_error(run_standard(), 2, {"in.bag", "not a bag"});
  write_bag(2);
  expect_error(run_standard("--topic /other"), 2, {"/other", "/particles (sensor_msgs/PointCloud2)"});
  expect_error(run("--bag @/in.bag --mesh @/none.ply --spacing 0.2 --out @/out"), 2, {"none.ply"});
  write_file(folder_ / "bad.ply", "ply\nnot really");
  expect_error(run("--bag @/in.bag --mesh @/bad.ply --spacing 0.2 --out @/out"), 2, {"bad.ply"});
  write_bag(2, [](int n, sensor_msgs::PointCloud2& cloud) {
    if (n == 0) cloud = to_point_cloud(make_particle_frame(0, {}, {}), "world");
  });
  expect_error(run_standard(), 2, {"frame 0", "no particles", "--first"});
  write_bag(2, [](int, sensor_msgs::PointCloud2& cloud) { cloud.row_step += 1; });
  expect_error(run_standard(), 2, {"frame 0", "row_step"});
}

TEST_F(TrackBag, MeshAndParticlesThatDoNotBelongTogetherAreATrackingError) {
  write_bag(2);
  write_ply(folder_ / "ball.ply", make_sphere(Vec3d(0, 0, 50), 1.0, 3));
  expect_error(run_standard(), 3, {"frame 0", "246 r", "3 r"});
}

TEST_F(TrackBag, BadFramesInTheMiddleAreSkippedAndSaid) {
  write_bag(7, [](int n, sensor_msgs::PointCloud2& cloud) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    if (n == 2) std::memcpy(cloud.data.data(), &nan, sizeof nan);
    if (n == 3) cloud.data.pop_back();
    if (n == 5) std::copy_n(&cloud.data[12], 4, &cloud.data[12 + cloud.point_step]);
  });
  const Outcome outcome = run_standard("--report @/report.jsonl");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("4 frames tracked"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("3 frames skipped"), std::string::npos) << outcome.out;
  ASSERT_EQ(report().size(), 7u);
  for (const int n : {2, 3, 5}) {
    EXPECT_EQ(report()[static_cast<std::size_t>(n)]["frame"], n);
    EXPECT_TRUE(report()[static_cast<std::size_t>(n)].contains("error"));
    EXPECT_NE(outcome.err.find("frame " + std::to_string(n) + " skipped"), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(files_in("out"),
            (std::vector<std::string>{"frame_000000.ply", "frame_000001.ply", "frame_000004.ply", "frame_000006.ply"}));
}

TEST_F(TrackBag, EmptyFrameInTheMiddleIsNoError) {
  write_bag(4, [](int n, sensor_msgs::PointCloud2& cloud) {
    if (n == 2) cloud = to_point_cloud(make_particle_frame(0, {}, {}), "world");
  });
  const Outcome outcome = run_standard("--report @/report.jsonl");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  ASSERT_EQ(report().size(), 4u);
  EXPECT_EQ(report()[2]["particles"], 0);
  EXPECT_FALSE(report()[2].contains("error"));
}

TEST_F(TrackBag, CutBagIsTrackedAsFarAsItGoes) {
  write_bag(24);
  const std::string bytes = read_file(folder_ / "in.bag");
  write_file(folder_ / "in.bag", bytes.substr(0, bytes.size() * 3 / 4));
  const Outcome outcome = run_standard("--report @/report.jsonl --format none");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("track_bag: warning: "), std::string::npos) << outcome.err;
  EXPECT_GE(report().size(), 12u);
  EXPECT_LE(report().size(), 18u);
}

TEST_F(TrackBag, OutputErrorsComeBeforeAnyTracking) {
  write_bag(2);
  write_file(folder_ / "file", "x");
  expect_error(run("--bag @/in.bag --mesh @/ball.ply --spacing 0.2 --out @/file"), 4, {"file"});
  expect_error(run("--bag @/in.bag --mesh @/ball.ply --spacing 0.2 --out /proc/meshes"), 4, {"/proc/meshes"});
  expect_error(run_standard("--surface /proc/meshes"), 4, {"/proc/meshes"});
  expect_error(run_standard("--report @/file/report.jsonl"), 4, {"file/report.jsonl"});
  expect_error(run_standard("--out-bag @/file/out.bag"), 4, {"file/out.bag"});
  EXPECT_TRUE(files_in("out").empty());
}

TEST_F(TrackBag, FullDiskIsAnOutputErrorAndLeavesWholeFilesOnly) {
  write_bag(4);
  // No file may grow beyond 8 × 512 bytes, as on a disk that fills up.
  const std::string arguments = "--bag @/in.bag --mesh @/ball.ply --spacing 0.2 --out @/out ";
  expect_error(run(arguments, "ulimit -f 8;"), 4, {"frame_000000.ply"});
  EXPECT_TRUE(files_in("out").empty());
  expect_error(run(arguments + "--format none --out-bag @/out.bag", "ulimit -f 8;"), 4, {"out.bag"});
  // A report on a full device.
  expect_error(run_standard("--report /dev/full"), 4, {"/dev/full"});
}

TEST_F(TrackBag, InterruptLeavesWhatWasWrittenComplete) {
  write_bag(600);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const std::string bag = folder_ / "in.bag", mesh = folder_ / "ball.ply", out = folder_ / "out",
                      out_bag = folder_ / "out.bag", lines = folder_ / "report.jsonl";
    execl(PST_TRACK_BAG, "track_bag", "--quiet", "--bag", bag.c_str(), "--mesh", mesh.c_str(), "--spacing", "0.2",
          "--out", out.c_str(), "--out-bag", out_bag.c_str(), "--report", lines.c_str(), nullptr);
    _exit(127);
  }
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!std::filesystem::exists(folder_ / "out/frame_000003.ply") && std::chrono::steady_clock::now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);

  const std::size_t frames = report().size();
  EXPECT_GE(frames, 4u);
  EXPECT_LT(frames, 600u);
  ASSERT_EQ(files_in("out").size(), frames);
  EXPECT_NO_THROW(read_initial_mesh(folder_ / ("out/" + files_in("out").back())));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out.bag.part"));
  rosbag::Bag bag(folder_ / "out.bag");
  EXPECT_EQ(rosbag::View(bag).size(), 2 * frames);
}

TEST_F(TrackBag, ThreadsDoNotChangeTheMeshes) {
  write_bag(4);
  ASSERT_EQ(run_standard("--threads 1").code, 0);
  ASSERT_EQ(run("--bag @/in.bag --mesh @/ball.ply --spacing 0.2 --out @/out2 --threads 2").code, 0);
  for (const std::string& name : files_in("out")) {
    EXPECT_EQ(read_file(folder_ / ("out/" + name)), read_file(folder_ / ("out2/" + name))) << name;
  }
}

TEST(Config, DefaultFileHoldsEveryParameterWithItsDefault) {
  const std::string path = PST_CONFIG "/default.yaml";
  const std::string text = read_file(path);
  Parameters parameters;
  read_parameter_file(path, parameters);
  for (const ParameterInfo& info : parameter_table()) {
    if (info.name == "particle_spacing") continue;
    EXPECT_EQ(get_parameter(parameters, info.name), get_parameter(Parameters(), info.name)) << info.name;
    EXPECT_NE(text.find("\n" + info.name + ": "), std::string::npos) << info.name;
  }
}

}  // namespace
}  // namespace particle_surface_tracker::test
