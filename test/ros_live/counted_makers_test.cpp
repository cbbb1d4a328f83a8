// distributed.launch as a user starts it, with one maker on this host, and the second by surface_maker.launch, as on
// another one.

#include <algorithm>

#include <gtest/gtest.h>
#include <particle_surface_tracker/ParticleSurface.h>

#include "ros_live/counted_command.h"
#include "ros_live/live_node.h"
#include "ros_live/node_process.h"

namespace particle_surface_tracker::test {
namespace {

constexpr int kFrames = 12;

TEST(DistributedLaunch, BothMakersAreJoined) {
  Collector<TrackedMesh> meshes("/tracker/mesh");
  Collector<TrackerStatus> statuses("/tracker/status");
  Collector<ParticleSurface> surfaces("/surfaces");
  const auto publisher = ros::NodeHandle().advertise<sensor_msgs::PointCloud2>("/particles", 100);
  Command first(launch("distributed.launch", {"spacing:=0.2", "makers:=2", "local:=1", "surface_wait:=20"}));
  Command second(
      {"roslaunch", "particle_surface_tracker", "surface_maker.launch", "spacing:=0.2", "every:=2", "offset:=1"});
  ASSERT_TRUE(wait_until([&] {
    return publisher.getNumSubscribers() == 3 && connection_count("/tracker_manager", "/surfaces") == 2;
  })) << publisher.getNumSubscribers();
  ASSERT_TRUE(meshes.wait_for_publisher());
  ASSERT_TRUE(statuses.wait_for_publisher());
  ASSERT_TRUE(surfaces.wait_for_publisher(2));
  EXPECT_NE(process_of("/surface_maker_0"), 0);
  EXPECT_NE(process_of("/surface_maker_1"), 0);

  for (int n = 0; n < kFrames; ++n) publisher.publish(drops_cloud(n));
  const auto received = meshes.wait_for(kFrames);
  ASSERT_EQ(received.size(), std::size_t{kFrames});
  FrameHandlerOptions options;
  options.parameters.particle_spacing = kBallSpacing;
  FrameHandler offline(options);
  for (int n = 0; n < kFrames; ++n) {
    offline.handle(*drops_cloud(n), static_cast<std::uint64_t>(n));
    EXPECT_EQ(bytes_of(*received[static_cast<std::size_t>(n)]), bytes_of(offline.message())) << n;
  }
  ASSERT_EQ(statuses.wait_for(kFrames).size(), std::size_t{kFrames});
  const TrackerStatus last = *statuses.wait_for(kFrames).back();
  EXPECT_EQ(last.surfaces_joined + last.surfaces_own, std::uint64_t{kFrames});
  // All but the first, if the surface of that one, which is not asked for, does not come so late that its maker seems
  // slow.
  EXPECT_GE(last.surfaces_joined, kFrames / 2u);
  const auto made = surfaces.wait_for(kFrames);
  ASSERT_EQ(made.size(), std::size_t{kFrames});
  const auto of_second =
      std::count_if(made.begin(), made.end(), [](const auto& surface) { return surface->offset == 1; });
  EXPECT_EQ(of_second, kFrames / 2);
}

}  // namespace
}  // namespace particle_surface_tracker::test
