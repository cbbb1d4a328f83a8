// Implicit surfaces of a nodelet in the manager of the tracker.

#include <string>

#include <gtest/gtest.h>
#include <particle_surface_tracker/ParticleSurface.h>

#include "ros_live/live_node_test.h"

namespace particle_surface_tracker::test {
namespace {

constexpr int kFrames = 8;

class LiveSurfaces : public LiveNodeTest {
 protected:
  /// A tracker that takes surfaces from its own namespace.
  std::unique_ptr<LiveNode> load_joining(std::map<std::string, std::string> parameters = {}) const {
    parameters.emplace("surfaces", kTopic);
    parameters.emplace("surface_wait", "20");  // The machine may be busy.
    return load(parameters);
  }

  /// The other nodelet.
  static void load_maker(const LiveNode& tracker, double spacing = kBallSpacing) {
    ros::param::set("/maker/spacing", spacing);
    const ros::M_string remappings = {{ros::names::resolve("particles"), tracker.input()},
                                      {ros::names::resolve("surfaces"), kTopic}};
    ASSERT_TRUE(manager().load("/maker", "particle_surface_tracker/ImplicitSurfaceNodelet", remappings, {}));
  }
  void TearDown() override { manager().unload("/maker"); }

  static void expect_offline_meshes(LiveNode& node, Collector<TrackedMesh>& meshes, int frames) {
    FrameHandler offline = handler();
    for (int n = 0; n < frames; ++n) {
      ASSERT_LE(node.answer(n).state, TrackerStatus::TRACKED);
      offline.handle(*ball_cloud(n), static_cast<std::uint64_t>(n));
      const auto count = static_cast<std::size_t>(n) + 1;
      ASSERT_EQ(meshes.wait_for(count).size(), count);
      EXPECT_EQ(bytes_of(*meshes.wait_for(count).back()), bytes_of(offline.message())) << n;
    }
  }

  static constexpr const char* kTopic = "/maker/surfaces";
};

TEST_F(LiveSurfaces, AreJoinedAndGiveTheSameBytes) {
  Collector<ParticleSurface> surfaces(kTopic);
  Collector<ParticleSurface> again(kTopic);
  const auto node = load_joining();
  Collector<TrackedMesh> meshes(node->name() + "/mesh");
  ASSERT_TRUE(meshes.wait_for_publisher());
  ASSERT_NO_FATAL_FAILURE(load_maker(*node));
  ASSERT_TRUE(surfaces.wait_for_publisher());
  ASSERT_TRUE(again.wait_for_publisher());
  ASSERT_NO_FATAL_FAILURE(expect_offline_meshes(*node, meshes, kFrames));
  const TrackerStatus last = *node->statuses().wait_for(kFrames).back();
  EXPECT_EQ(last.surfaces_own, 1u);  // The first, of which the mesh is fitted.
  EXPECT_EQ(last.surfaces_joined, kFrames - 1u);
  // Within a process, all subscribers get the very same message.
  const auto first = surfaces.wait_for(kFrames);
  const auto second = again.wait_for(kFrames);
  ASSERT_EQ(first.size(), std::size_t{kFrames});
  EXPECT_EQ(first, second);
}

// All frames are on their way at once: surfaces are made while frames before them are tracked.
TEST_F(LiveSurfaces, OfFramesInFlightAreJoinedInOrder) {
  const auto node = load_joining();
  Collector<TrackedMesh> meshes(node->name() + "/mesh");
  Collector<ParticleSurface> surfaces(kTopic);
  ASSERT_TRUE(meshes.wait_for_publisher());
  ASSERT_NO_FATAL_FAILURE(load_maker(*node));
  ASSERT_TRUE(surfaces.wait_for_publisher());
  for (int n = 0; n < kFrames; ++n) node->send(n);
  const auto statuses = node->statuses().wait_for(kFrames);
  ASSERT_EQ(statuses.size(), std::size_t{kFrames});
  const auto received = meshes.wait_for(kFrames);
  ASSERT_EQ(received.size(), std::size_t{kFrames});
  FrameHandler offline = handler();
  for (int n = 0; n < kFrames; ++n) {
    const auto at = static_cast<std::size_t>(n);
    offline.handle(*ball_cloud(n), static_cast<std::uint64_t>(n));
    EXPECT_EQ(received[at]->header.stamp, ball_cloud(n)->header.stamp) << n;
    EXPECT_EQ(bytes_of(*received[at]), bytes_of(offline.message())) << n;
    EXPECT_EQ(statuses[at]->frame, static_cast<std::uint64_t>(n));
  }
  EXPECT_EQ(statuses.back()->surfaces_joined, kFrames - 1u);
  EXPECT_EQ(statuses.back()->surfaces_own, 1u);
}

TEST_F(LiveSurfaces, OfOtherParametersAreNotTaken) {
  const auto node = load_joining();
  Collector<TrackedMesh> meshes(node->name() + "/mesh");
  Collector<ParticleSurface> surfaces(kTopic);
  ASSERT_TRUE(meshes.wait_for_publisher());
  ASSERT_NO_FATAL_FAILURE(load_maker(*node, 0.19));
  ASSERT_TRUE(surfaces.wait_for_publisher());
  ASSERT_NO_FATAL_FAILURE(expect_offline_meshes(*node, meshes, 4));
  const TrackerStatus last = *node->statuses().wait_for(4).back();
  EXPECT_EQ(last.surfaces_own, 4u);
  EXPECT_EQ(last.surfaces_joined, 0u);
}

TEST_F(LiveSurfaces, WhereNobodyMakesThemNobodyWaits) {
  const auto node = load_joining({{"surface_wait", "3600"}});
  Collector<TrackedMesh> meshes(node->name() + "/mesh");
  ASSERT_TRUE(meshes.wait_for_publisher());
  ASSERT_NO_FATAL_FAILURE(expect_offline_meshes(*node, meshes, 4));
  EXPECT_EQ(node->statuses().wait_for(4).back()->surfaces_own, 4u);
}

TEST_F(LiveSurfaces, ANodeThatWaitsCanBeUnloaded) {
  auto node = load_joining({{"surface_wait", "3600"}});
  ros::Publisher silent = ros::NodeHandle().advertise<ParticleSurface>(kTopic, 1);
  ASSERT_TRUE(wait_until([&] { return silent.getNumSubscribers() > 0; }));
  node->answer(0);
  node->send(1);
  ros::WallDuration(0.2).sleep();
  const auto begin = ros::WallTime::now();
  node.reset();
  EXPECT_LT((ros::WallTime::now() - begin).toSec(), 60.0);
}

TEST_F(LiveSurfaces, ParametersThatCannotBeAreRefused) {
  EXPECT_FALSE(load_joining({{"surface_wait", "-1"}})->loaded());
}

}  // namespace
}  // namespace particle_surface_tracker::test
