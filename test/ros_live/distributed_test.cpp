// A tracker and two nodes that make the implicit surfaces of its frames, in processes of their own, maybe on other
// hosts. One of them is killed, or stalls: nothing is lost, and no byte differs.

#include <csignal>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "particle_surface_tracker/ros/time_conversion.h"
#include "ros_live/live_node.h"
#include "ros_live/node_process.h"

namespace particle_surface_tracker::test {
namespace {

constexpr int kFrames = 24;

// Both makers are connected to the tracker, and all three to this program.
class Distributed : public testing::Test {
 protected:
  void SetUp() override {
    publisher_ = ros::NodeHandle().advertise<sensor_msgs::PointCloud2>("particles", 100);
    ASSERT_TRUE(wait_until([&] {
      return publisher_.getNumSubscribers() == 3 && connection_count("/tracker", "/surfaces") == 2;
    })) << publisher_.getNumSubscribers();
    ASSERT_TRUE(meshes_.wait_for_publisher());
    ASSERT_TRUE(statuses_.wait_for_publisher());
  }

  TrackerStatus answer(int n) {
    const std::size_t before = statuses_.wait_for(0).size();
    publisher_.publish(drops_cloud(n));
    const auto all = statuses_.wait_for(before + 1);
    EXPECT_GT(all.size(), before) << "the tracker does not answer";
    return all.size() > before ? *all[before] : TrackerStatus();
  }

  void expect_offline_meshes() {
    // A subscriber gets the last mesh of the run before at once.
    ASSERT_TRUE(wait_until([&] {
      const auto received = meshes_.wait_for(kFrames);
      return received.size() >= kFrames && received.back()->header.stamp == drops_cloud(kFrames - 1)->header.stamp;
    }));
    auto received = meshes_.wait_for(kFrames);
    received.erase(received.begin(), received.end() - kFrames);
    FrameHandlerOptions options;
    options.parameters.particle_spacing = kBallSpacing;
    FrameHandler offline(options);
    for (int n = 0; n < kFrames; ++n) {
      offline.handle(*drops_cloud(n), static_cast<std::uint64_t>(n));
      TrackedMesh mesh = *received[static_cast<std::size_t>(n)];
      // A later run of the same node numbers on.
      mesh.topology_version = offline.message().topology_version;
      EXPECT_EQ(bytes_of(mesh), bytes_of(offline.message())) << n;
    }
  }

  ros::Publisher publisher_;
  Collector<TrackedMesh> meshes_{"/tracker/mesh"};
  Collector<TrackerStatus> statuses_{"/tracker/status"};
};

TEST_F(Distributed, AMakerThatIsKilledIsDoneWithout) {
  for (int n = 0; n < kFrames / 2; ++n) ASSERT_LE(answer(n).state, TrackerStatus::TRACKED);
  const TrackerStatus half = *statuses_.wait_for(kFrames / 2).back();
  EXPECT_GE(half.surfaces_joined, 9u);  // Of 11: the first frame has none, and the machine may be busy.
  const pid_t killed = kill_node("/odd");
  ASSERT_NE(killed, 0);
  int waited = 0;
  for (int n = kFrames / 2; n < kFrames; ++n) {
    const TrackerStatus status = answer(n);
    ASSERT_EQ(status.state, TrackerStatus::TRACKED);
    waited += status.latency > 4.0 ? 1 : 0;
  }
  // It is not waited for again and again.
  EXPECT_LE(waited, 2);
  const TrackerStatus last = *statuses_.wait_for(kFrames).back();
  EXPECT_EQ(last.frames_tracked, std::uint64_t{kFrames});
  EXPECT_EQ(last.surfaces_joined + last.surfaces_own, last.frames_tracked);
  EXPECT_GE(last.surfaces_joined, half.surfaces_joined + 4);
  EXPECT_GT(last.surfaces_own, half.surfaces_own);
  expect_offline_meshes();
}

// Needs somebody who starts again what was killed.
TEST_F(Distributed, AMakerThatStallsIsJoinedAgainLater) {
  const TrackerStatus first = answer(0);
  ASSERT_EQ(first.state, TrackerStatus::STARTED);
  const pid_t stalled = process_of("/even");
  ASSERT_NE(stalled, 0);
  kill(stalled, SIGSTOP);
  for (int n = 1; n < 8; ++n) ASSERT_EQ(answer(n).state, TrackerStatus::TRACKED);
  const TrackerStatus without = *statuses_.wait_for(0).back();
  EXPECT_GE(without.surfaces_own, first.surfaces_own + 3);
  kill(stalled, SIGCONT);
  for (int n = 8; n < kFrames; ++n) {
    ASSERT_EQ(answer(n).state, TrackerStatus::TRACKED);
    ros::WallDuration(0.05).sleep();
  }
  const TrackerStatus last = *statuses_.wait_for(0).back();
  // More than those of the other alone.
  EXPECT_GT(last.surfaces_joined - without.surfaces_joined, 8u);
  expect_offline_meshes();
}

// All frames are on their way at once: both makers work on frames that the tracker has not come to.
TEST_F(Distributed, FramesInFlightAreJoinedInOrder) {
  const auto before = static_cast<std::ptrdiff_t>(statuses_.wait_for(0).size());
  for (int n = 0; n < kFrames; ++n) publisher_.publish(drops_cloud(n));
  auto statuses = statuses_.wait_for(static_cast<std::size_t>(before) + kFrames);
  statuses.erase(statuses.begin(), statuses.begin() + before);
  ASSERT_EQ(statuses.size(), std::size_t{kFrames});
  for (int n = 0; n < kFrames; ++n) {
    const TrackerStatus& status = *statuses[static_cast<std::size_t>(n)];
    ASSERT_LE(status.state, TrackerStatus::TRACKED) << n;
    EXPECT_EQ(status.header.stamp, drops_cloud(n)->header.stamp) << n;
  }
  const TrackerStatus& last = *statuses.back();
  EXPECT_EQ(last.surfaces_joined + last.surfaces_own, last.frames_tracked);
  // All but the first, were the machine never busy.
  EXPECT_GE(last.surfaces_joined - statuses.front()->surfaces_joined, kFrames / 2u);
  expect_offline_meshes();
}

}  // namespace
}  // namespace particle_surface_tracker::test
