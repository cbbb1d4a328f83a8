// Nodes that are killed at random moments and come up again, against a run that is never interrupted.

#include <filesystem>
#include <map>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "particle_surface_tracker/ros/time_conversion.h"
#include "ros_live/live_node.h"
#include "ros_live/node_process.h"
#include "ros_live/reconfigure.h"
#include "support/temporary_folder.h"

namespace particle_surface_tracker::test {
namespace {

constexpr int kFrames = 16;
constexpr int kEvery = 3;  // As in respawn.test.

using Meshes = std::map<std::int64_t, std::string>;  // Bytes by stamp.

Meshes uninterrupted() {
  FrameHandlerOptions options;
  options.parameters.particle_spacing = kBallSpacing;
  FrameHandler offline(options);
  Meshes meshes;
  for (int n = 0; n < kFrames; ++n) {
    offline.handle(*drops_cloud(n), static_cast<std::uint64_t>(n));
    meshes[to_nanoseconds(drops_cloud(n)->header.stamp)] = bytes_of(offline.message());
  }
  return meshes;
}

class KilledNode {
 public:
  /// \param process name of the node whose process is killed, which may be a manager.
  KilledNode(const std::string& name, std::string process)
      : process_(std::move(process)), meshes_(name + "/mesh"), statuses_(name + "/status") {
    publisher_ = ros::NodeHandle().advertise<sensor_msgs::PointCloud2>(name + "/particles", 100);
    ros::param::get(name + "/checkpoint", checkpoint_);
  }
  ~KilledNode() {
    std::error_code ignored;
    std::filesystem::remove_all(std::filesystem::path(checkpoint_).parent_path(), ignored);
  }
  KilledNode(const KilledNode&) = delete;
  KilledNode& operator=(const KilledNode&) = delete;

  void send(int n) { publisher_.publish(drops_cloud(n)); }

  /// What became of a frame, which is sent until there is an answer: a connection may not be there yet. To send one
  /// twice does no harm, it is skipped then.
  TrackerStatus answer(int n) {
    const std::size_t before = statuses_.wait_for(0).size();
    TrackerStatus status;
    EXPECT_TRUE(wait_until([&] {
      send(n);
      const auto all = statuses_.wait_for(before + 1, std::chrono::seconds(2));
      for (std::size_t k = before; k < all.size(); ++k) {
        status = *all[k];
        if (status.header.stamp == drops_cloud(n)->header.stamp) return true;
      }
      return false;
    }));
    return status;
  }

  void kill_and_wait() {
    const pid_t killed = kill_node(process_);
    ASSERT_NE(killed, 0);
    ASSERT_TRUE(wait_for_respawn(process_, killed));
    ++kills_;
  }

  bool has_checkpoint() const { return std::filesystem::exists(checkpoint_); }
  int kills() const { return kills_; }
  Collector<TrackedMesh>& meshes() { return meshes_; }

 private:
  std::string process_;
  std::string checkpoint_;
  Collector<TrackedMesh> meshes_;
  Collector<TrackerStatus> statuses_;
  ros::Publisher publisher_;
  int kills_ = 0;
};

void expect_same_meshes(const std::string& name, const std::string& process, int kills, double settling) {
  const Meshes wanted = uninterrupted();
  KilledNode node(name, process);
  std::mt19937 random(1);
  int tracked = -1;  // The last frame that was answered as tracked.
  int kept = -1;     // The last one that is in a checkpoint for certain.
  for (int kill = 0; kill < kills; ++kill) {
    // The source begins again every time; what is known is skipped.
    const int end = std::uniform_int_distribution<int>(2 + 3 * kill, 3 * kill + 4)(random);
    for (int n = 0; n < end; ++n) {
      const TrackerStatus status = node.answer(n);
      ASSERT_LE(status.state, TrackerStatus::SKIPPED) << status.reason;
      // At most the frames since the last checkpoint are made again.
      EXPECT_TRUE(n > kept || status.state == TrackerStatus::SKIPPED) << "frame " << n << " of kill " << kill;
      EXPECT_TRUE(status.state == TrackerStatus::SKIPPED || status.frame == static_cast<std::uint64_t>(n));
      tracked = std::max(tracked, n);
    }
    kept = tracked - kEvery;
    ros::WallDuration(settling).sleep();
    node.send(end);
    ros::WallDuration(0, std::uniform_int_distribution<int>(0, 30000000)(random)).sleep();
    ASSERT_NO_FATAL_FAILURE(node.kill_and_wait());
  }
  for (int n = 0; n < kFrames; ++n) node.answer(n);
  EXPECT_EQ(node.kills(), kills);
  EXPECT_TRUE(node.has_checkpoint());
  ASSERT_TRUE(wait_until([&] {
    const auto received = node.meshes().wait_for(0);
    return !received.empty() && to_nanoseconds(received.back()->header.stamp) == wanted.rbegin()->first;
  }));
  for (const auto& mesh : node.meshes().wait_for(0)) {
    EXPECT_EQ(bytes_of(*mesh), wanted.at(to_nanoseconds(mesh->header.stamp))) << mesh->header.stamp;
  }
}

TEST(Respawn, ANodeGoesOnAsIfNothingHadBeen) {
  expect_same_meshes("/alone", "/alone", /*kills*/ 5, /*settling*/ 0.0);
}

TEST(Respawn, ANodeletGoesOnAsIfNothingHadBeen) {
  // The loader of a nodelet learns from a bond that its manager is gone. Where that happens in the first seconds, it
  // may wait for ever.
  expect_same_meshes("/managed", "/manager", /*kills*/ 2, /*settling*/ 4.0);
}

TEST(Respawn, AValueThatWaitsForAResetLosesNoRun) {
  const std::string name = "/reconfigured";
  const Meshes wanted = uninterrupted();
  KilledNode node(name, name);
  for (int n = 0; n < 4; ++n) ASSERT_LE(node.answer(n).state, TrackerStatus::SKIPPED);
  Reconfigure(name).set("dx_phi", 0.75);
  node.answer(4);
  ASSERT_TRUE(wait_until([&] { return node.has_checkpoint(); }));
  ASSERT_NO_FATAL_FAILURE(node.kill_and_wait());
  // The source begins again. Frame 4 may have been answered, but not yet kept.
  for (int n = 0; n < 4; ++n) EXPECT_EQ(node.answer(n).state, TrackerStatus::SKIPPED) << n;
  node.answer(4);
  const TrackerStatus next = node.answer(5);
  EXPECT_EQ(next.state, TrackerStatus::TRACKED) << next.reason;
  EXPECT_EQ(next.frame, 5u);
  EXPECT_EQ(value_of<double>(*Reconfigure(name).updates().wait_for(1).back(), "dx_phi"), 0.75);
  ASSERT_TRUE(wait_until([&] {
    const auto received = node.meshes().wait_for(0);
    return !received.empty() && received.back()->header.stamp == drops_cloud(5)->header.stamp;
  }));
  for (const auto& mesh : node.meshes().wait_for(0)) {
    EXPECT_TRUE(bytes_of(*mesh) == wanted.at(to_nanoseconds(mesh->header.stamp))) << mesh->header.stamp;
  }
}

TEST(Respawn, ANodeThatIsInterruptedTakesItsParametersAway) {
  const std::string name = "/interrupted";
  Collector<dynamic_reconfigure::Config> updates(name + "/parameter_updates");
  ASSERT_EQ(updates.wait_for(1).size(), 1u);
  EXPECT_TRUE(ros::param::has(name + "/dx_phi"));
  EXPECT_TRUE(ros::param::has(name + "/parameter_record"));
  Reconfigure(name).set("tau", 0.3);
  ASSERT_NE(kill_node(name, SIGINT), 0);
  EXPECT_TRUE(wait_until([&] { return !ros::param::has(name + "/parameter_record"); }));
  EXPECT_FALSE(ros::param::has(name + "/dx_phi"));
  double tau = 0.0;
  EXPECT_TRUE(ros::param::get(name + "/tau", tau));
  EXPECT_EQ(tau, 0.6);
}

TEST(Respawn, AnotherConfigHoldsAfterAnOrderlyEndAndAfterACrash) {
  const std::string name = "/configured";
  const TemporaryFolder folder;
  const auto tau_with = [&](const std::string& config, int signal) {
    ros::param::set(name + "/config", config);
    const pid_t ended = kill_node(name, signal);
    EXPECT_TRUE(ended != 0 && wait_for_respawn(name, ended));
    Collector<dynamic_reconfigure::Config> updates(name + "/parameter_updates");
    const auto received = updates.wait_for(1);
    return received.empty() ? 0.0 : value_of<double>(*received.back(), "tau");
  };
  const std::string one = folder.write("one.yaml", "tau: 0.9\n");
  const std::string two = folder.write("two.yaml", "tau: 0.25\n");
  ASSERT_TRUE(wait_until([&] { return process_of(name) != 0; }));
  for (const int signal : {SIGINT, SIGKILL}) {
    EXPECT_EQ(tau_with(one, signal), 0.9) << signal;
    EXPECT_EQ(tau_with(two, signal), 0.25) << signal;
  }
}

}  // namespace
}  // namespace particle_surface_tracker::test
