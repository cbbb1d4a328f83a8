// Checkpoints of the live node: by service, by itself, and when it comes up.

#include <algorithm>
#include <filesystem>
#include <string>

#include <gtest/gtest.h>
#include <particle_surface_tracker/CheckpointFile.h>
#include <rosgraph_msgs/Log.h>

#include "particle_surface_tracker/io/checkpoint.h"
#include "ros/ros_test_support.h"
#include "ros_live/live_node_test.h"
#include "ros_live/reconfigure.h"

namespace particle_surface_tracker::test {
namespace {

using State = TrackerStatus;

constexpr int kFrames = 10;

CheckpointFile::Response call(const LiveNode& node, const std::string& service, const std::string& path) {
  CheckpointFile call;
  call.request.path = path;
  EXPECT_TRUE(ros::service::call(node.name() + "/" + service, call));
  return call.response;
}

class LiveCheckpoints : public LiveNodeTest {
 protected:
  /// A node that tracks the drops, whose files are in the folder of the test.
  std::unique_ptr<LiveNode> load_drops(std::map<std::string, std::string> parameters = {}) const {
    parameters.emplace("mesh", "implicit");
    parameters.emplace("publish_velocities", "true");
    parameters.emplace("save_folder", folder_.path().string());
    return load(parameters);
  }

  static FrameHandler drops_handler() {
    FrameHandlerOptions options;
    options.parameters.particle_spacing = kBallSpacing;
    return FrameHandler(options);
  }

  /// The messages of a run that is never interrupted.
  static const std::vector<TrackedMesh>& uninterrupted() {
    static const std::vector<TrackedMesh> messages = [] {
      std::vector<TrackedMesh> made;
      FrameHandler offline = drops_handler();
      for (int n = 0; n < kFrames; ++n) {
        offline.handle(*drops_cloud(n), static_cast<std::uint64_t>(n));
        made.push_back(offline.message({/*normals*/ false, /*velocities*/ true}));
      }
      return made;
    }();
    return messages;
  }

  /// Sends frames and expects the meshes of the uninterrupted run.
  void expect_goes_on(LiveNode& node, int first) const {
    Collector<TrackedMesh> meshes(node.name() + "/mesh");
    ASSERT_TRUE(meshes.wait_for_publisher());
    // That of the checkpoint comes at once.
    ASSERT_EQ(meshes.wait_for(1).size(), 1u);
    for (int n = first; n < kFrames; ++n) {
      const State status = node.answer(drops_cloud(n));
      ASSERT_EQ(status.state, State::TRACKED) << status.reason;
      EXPECT_EQ(status.frame, static_cast<std::uint64_t>(n));
      EXPECT_EQ(status.frames_missing, 0u);
    }
    const auto received = meshes.wait_for(static_cast<std::size_t>(kFrames - first) + 1);
    ASSERT_EQ(received.size(), static_cast<std::size_t>(kFrames - first) + 1);
    for (std::size_t k = 0; k < received.size(); ++k) {
      TrackedMesh mesh = *received[k];
      const TrackedMesh& wanted = uninterrupted()[static_cast<std::size_t>(first) + k - 1];
      // Where meshes of this node came before, it must be another one than theirs.
      EXPECT_GE(mesh.topology_version, wanted.topology_version);
      mesh.topology_version = wanted.topology_version;
      EXPECT_EQ(bytes_of(mesh), bytes_of(wanted)) << wanted.header.stamp;
    }
  }

  void send(LiveNode& node, int end) const {
    for (int n = 0; n < end; ++n) ASSERT_LE(node.answer(drops_cloud(n)).state, State::TRACKED);
  }
};

TEST_F(LiveCheckpoints, ARunGoesOnInAnotherNode) {
  const auto one = load_drops();
  const CheckpointFile::Response early = call(*one, "save_checkpoint", "early.checkpoint");
  EXPECT_FALSE(early.success);
  EXPECT_NE(early.message.find("nothing is tracked"), std::string::npos) << early.message;
  send(*one, 6);
  const CheckpointFile::Response saved = call(*one, "save_checkpoint", "a/run.checkpoint");
  ASSERT_TRUE(saved.success) << saved.message;
  EXPECT_EQ(std::filesystem::path(saved.path), std::filesystem::canonical(folder_.path()) / "a/run.checkpoint");
  const auto two = load_drops();
  const CheckpointFile::Response loaded = call(*two, "load_checkpoint", "a/run.checkpoint");
  ASSERT_TRUE(loaded.success) << loaded.message;
  EXPECT_EQ(loaded.path, saved.path);
  expect_goes_on(*two, 6);
}

TEST_F(LiveCheckpoints, ARunGoesBackToItsCheckpoint) {
  const auto node = load_drops();
  send(*node, 4);
  ASSERT_TRUE(call(*node, "save_checkpoint", "run.checkpoint").success);
  for (int n = 4; n < 8; ++n) node->answer(drops_cloud(n));
  ASSERT_TRUE(call(*node, "load_checkpoint", "run.checkpoint").success);
  // What the checkpoint holds already is passed over.
  for (int n = 0; n < 4; ++n) {
    const State status = node->answer(drops_cloud(n));
    EXPECT_EQ(status.state, State::SKIPPED);
    EXPECT_NE(status.reason.find("checkpoint"), std::string::npos) << status.reason;
  }
  expect_goes_on(*node, 4);
}

TEST_F(LiveCheckpoints, WhatIsRefusedChangesNothing) {
  const auto node = load_drops();
  send(*node, 3);
  ASSERT_TRUE(call(*node, "save_checkpoint", "good.checkpoint").success);
  const std::string good = read_file(folder_ / "good.checkpoint");
  folder_.write("cut.checkpoint", good.substr(0, good.size() / 2));
  std::string bytes = good;
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  folder_.write("flipped.checkpoint", bytes);
  folder_.write("foreign.checkpoint", "ply\nformat ascii 1.0\n");
  FrameHandler offline = drops_handler();
  offline.handle(*drops_cloud(0), 0);
  Checkpoint checkpoint;
  offline.save(checkpoint);
  write_checkpoint(folder_ / "bag.checkpoint", checkpoint);
  checkpoint.sections["node"] = "too short";
  write_checkpoint(folder_ / "section.checkpoint", checkpoint);
  checkpoint = read_checkpoint(folder_ / "good.checkpoint");
  checkpoint.sections["configured"] += "more";
  write_checkpoint(folder_ / "configured.checkpoint", checkpoint);
  const std::pair<const char*, const char*> refused[] = {{"cut.checkpoint", "damaged"},
                                                         {"flipped.checkpoint", "checksum"},
                                                         {"foreign.checkpoint", "no checkpoint"},
                                                         {"bag.checkpoint", "track_bag"},
                                                         {"section.checkpoint", "place in the input"},
                                                         {"configured.checkpoint", "configured parameters is damaged"},
                                                         {"none.checkpoint", "No such file"},
                                                         {"../good.checkpoint", "not below"},
                                                         {"mesh.ply", ".checkpoint"},
                                                         {"", "~checkpoint is not set"}};
  for (const auto& [path, reason] : refused) {
    const CheckpointFile::Response answer = call(*node, "load_checkpoint", path);
    EXPECT_FALSE(answer.success) << path;
    EXPECT_NE(answer.message.find(reason), std::string::npos) << path << ": " << answer.message;
    EXPECT_EQ(answer.path, "") << path;
  }
  for (const std::string path : {"../out.checkpoint", "mesh.ply", ""}) {
    EXPECT_FALSE(call(*node, "save_checkpoint", path).success) << path;
  }
  expect_goes_on(*node, 3);
  const auto other = load_drops({{"dx_phi", "0.6"}});
  const CheckpointFile::Response answer = call(*other, "load_checkpoint", "good.checkpoint");
  EXPECT_FALSE(answer.success);
  EXPECT_NE(answer.message.find("dx_phi is 0.5 there and 0.6 here"), std::string::npos) << answer.message;
}

TEST_F(LiveCheckpoints, AValueThatWaitsForAResetLosesNoRun) {
  Collector<rosgraph_msgs::Log> log("/rosout");
  ASSERT_TRUE(log.wait_for_publisher());
  const auto node = load_drops();
  send(*node, 3);
  EXPECT_EQ(value_of<double>(Reconfigure(node->name()).set("dx_phi", 0.75), "dx_phi"), 0.75);
  ASSERT_TRUE(call(*node, "save_checkpoint", "run.checkpoint").success);
  const CheckpointFile::Response loaded = call(*node, "load_checkpoint", "run.checkpoint");
  ASSERT_TRUE(loaded.success) << loaded.message;
  EXPECT_TRUE(wait_until([&] {
    const auto lines = log.wait_for(0);
    return std::any_of(lines.begin(), lines.end(), [&](const auto& line) {
      return line->level == rosgraph_msgs::Log::WARN &&
             line->msg.find(node->name() + ": goes on with the values of the checkpoint") == 0 &&
             line->msg.find("dx_phi 0.5 -> 0.75") != std::string::npos;
    });
  }));
  expect_goes_on(*node, 3);
  // It waits still.
  Collector<TrackedMesh> meshes(node->name() + "/mesh");
  ASSERT_TRUE(meshes.wait_for_publisher());
  call_reset(*node);
  const std::size_t before = meshes.wait_for(1).size();
  EXPECT_EQ(node->answer(drops_cloud(0)).state, State::STARTED);
  const auto received = meshes.wait_for(before + 1);
  ASSERT_EQ(received.size(), before + 1);
  EXPECT_NE(received.back()->vertices.size(), uninterrupted()[0].vertices.size());
}

TEST_F(LiveCheckpoints, ARunWithReconfiguredValuesGoesOnInANodeThatIsConfiguredAlike) {
  const auto one = load_drops();
  Reconfigure(one->name()).set("dx_phi", 0.75);
  send(*one, 3);
  ASSERT_TRUE(call(*one, "save_checkpoint", "run.checkpoint").success);
  const auto two = load_drops();
  const CheckpointFile::Response loaded = call(*two, "load_checkpoint", "run.checkpoint");
  ASSERT_TRUE(loaded.success) << loaded.message;
  Collector<TrackedMesh> meshes_of_one(one->name() + "/mesh");
  Collector<TrackedMesh> meshes_of_two(two->name() + "/mesh");
  ASSERT_EQ(meshes_of_one.wait_for(1).size(), 1u);
  ASSERT_EQ(meshes_of_two.wait_for(1).size(), 1u);
  one->answer(drops_cloud(3));
  two->answer(drops_cloud(3));
  ASSERT_EQ(meshes_of_one.wait_for(2).size(), 2u);
  ASSERT_EQ(meshes_of_two.wait_for(2).size(), 2u);
  EXPECT_EQ(bytes_of(*meshes_of_one.wait_for(2)[1]), bytes_of(*meshes_of_two.wait_for(2)[1]));
  // Whoever has configured something else is told.
  const auto three = load_drops({{"dx_phi", "0.6"}});
  const CheckpointFile::Response refused = call(*three, "load_checkpoint", "run.checkpoint");
  EXPECT_FALSE(refused.success);
  EXPECT_NE(refused.message.find("dx_phi is 0.75 there and 0.6 here"), std::string::npos) << refused.message;
}

TEST_F(LiveCheckpoints, ANodeGoesOnWhenItComesUp) {
  const std::map<std::string, std::string> parameters = {{"checkpoint", folder_ / "run.checkpoint"},
                                                         {"checkpoint_every", "4"}};
  {
    const auto node = load_drops(parameters);
    send(*node, 3);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "run.checkpoint"));
    node->answer(drops_cloud(3));
    EXPECT_TRUE(wait_until([&] { return std::filesystem::exists(folder_ / "run.checkpoint"); }));
    node->answer(drops_cloud(4));
    // It ends in order, and keeps what it has.
  }
  const auto node = load_drops(parameters);
  EXPECT_EQ(node->answer(drops_cloud(4)).state, State::SKIPPED);
  expect_goes_on(*node, 5);
}

TEST_F(LiveCheckpoints, ARunThatEndsTakesItsCheckpointAlong) {
  const std::string path = folder_ / "run.checkpoint";
  const auto node = load_drops({{"checkpoint", path}, {"checkpoint_every", "1"}});
  send(*node, 2);
  EXPECT_TRUE(wait_until([&] { return std::filesystem::exists(path); }));
  call_reset(*node);
  EXPECT_TRUE(wait_until([&] { return !std::filesystem::exists(path); }));
  EXPECT_EQ(node->answer(drops_cloud(5)).state, State::STARTED);
}

TEST_F(LiveCheckpoints, OtherParticlesBeginAnotherRun) {
  const std::string path = folder_ / "run.checkpoint";
  {
    const auto node = load_drops({{"checkpoint", path}, {"checkpoint_every", "1"}});
    send(*node, 3);
  }
  const auto node = load_drops({{"checkpoint", path}, {"checkpoint_every", "1"}});
  // The same stamp as that run's first frame, but a ball.
  const State begun = node->answer(ball_cloud(0));
  EXPECT_EQ(begun.state, State::STARTED) << begun.reason;
  EXPECT_EQ(begun.run, 2u);
  EXPECT_EQ(node->answer(ball_cloud(1)).state, State::TRACKED);
}

TEST_F(LiveCheckpoints, ARefusedFileIsSetAside) {
  const std::string path = folder_.write("run.checkpoint", "first");
  for (const std::string& aside : {path + ".refused", path + ".refused_2"}) {
    const std::string bytes = read_file(path);
    const auto node = load_drops({{"checkpoint", path}, {"checkpoint_every", "1"}});
    EXPECT_EQ(node->answer(drops_cloud(0)).state, State::STARTED);
    EXPECT_EQ(read_file(aside), bytes);
    EXPECT_TRUE(wait_until([&] { return std::filesystem::exists(path); }));
    EXPECT_TRUE(call(*node, "load_checkpoint", "").success);
    folder_.write("run.checkpoint", "second");
  }
}

TEST_F(LiveCheckpoints, ParametersThatCannotBeAreRefused) {
  EXPECT_FALSE(load_drops({{"checkpoint_every", "5"}})->loaded());
  EXPECT_FALSE(load_drops({{"checkpoint", "run.checkpoint"}})->loaded());
  EXPECT_FALSE(load_drops({{"checkpoint", folder_ / "none/run.checkpoint"}})->loaded());
  EXPECT_FALSE(load_drops({{"checkpoint", folder_ / "run.checkpoint"}, {"checkpoint_every", "-1"}})->loaded());
}

}  // namespace
}  // namespace particle_surface_tracker::test
