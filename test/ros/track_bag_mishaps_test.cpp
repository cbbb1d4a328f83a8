// The program track_bag itself: bad frames, cut bags, full disks and interrupts. What can be tracked is, and what was
// written is whole.

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <limits>
#include <thread>

#include <gtest/gtest.h>
#include <rosbag/view.h>

#include "particle_surface_tracker/io/mesh_reader.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "ros_test_support.h"
#include "track_bag_run.h"

namespace particle_surface_tracker::test {
namespace {

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

}  // namespace
}  // namespace particle_surface_tracker::test
