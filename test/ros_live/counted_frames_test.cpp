// Frames that are not tracked, because they come too fast, are all counted: those that the tracker skips, and those
// that roscpp drops without a word.

#include <csignal>

#include <gtest/gtest.h>
#include <rosbag/bag.h>

#include "particle_surface_tracker/ros/particle_conversion.h"
#include "ros_live/counted_command.h"
#include "ros_live/live_node.h"
#include "ros_live/node_process.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"

namespace particle_surface_tracker::test {
namespace {

// Waits for the answer to the cloud with a stamp.
TrackerStatus answer_to(Collector<TrackerStatus>& statuses, const ros::Time& stamp) {
  const auto has_come = [&] {
    const auto all = statuses.wait_for(0);
    return !all.empty() && all.back()->header.stamp == stamp;
  };
  EXPECT_TRUE(wait_until(has_come)) << statuses.wait_for(0).size() << " answers";
  const auto all = statuses.wait_for(1);
  return all.empty() ? TrackerStatus() : *all.back();
}

// Every frame takes the tracker a hundred times as long as the player.
TEST(CountedFrames, PolicyLatestTakesWhatItCanOfAPlayerThatDoesNotWait) {
  constexpr int kFrames = 100;
  constexpr double r = 0.1;
  const TemporaryFolder folder;
  const std::string name = folder / "fine.bag";
  ros::Time last_stamp;
  {
    ParticleFrame frame = fill_with_particles(Vec3d(-1, -1, -1), Vec3d(1, 1, 1), r, 0.0, 0,
                                              [](const Vec3d& x) { return x.norm() < 0.95; });
    rosbag::Bag bag(name, rosbag::bagmode::Write);
    for (int n = 0; n < kFrames; ++n) {
      frame.stamp_ns = 1000000000000 + n * std::int64_t{10000000};
      sensor_msgs::PointCloud2 cloud = to_point_cloud(frame, "tank");
      cloud.header.seq = static_cast<std::uint32_t>(n);
      last_stamp = cloud.header.stamp;
      bag.write("/particles", cloud.header.stamp, cloud);
      for (Vec3f& position : frame.positions) position.x() += static_cast<float>(r / 16);
    }
    bag.close();
  }
  Collector<TrackerStatus> statuses("/tracker/status");
  Command live(launch("live.launch", {"spacing:=0.1", "queue_policy:=latest"}));
  ASSERT_TRUE(statuses.wait_for_publisher());
  // It stays when it is through: what it still had to send would be gone with it.
  Command player({"rosbag", "play", "--quiet", "--keep-alive", "--wait-for-subscribers", "--rate", "10", name});
  const TrackerStatus last = answer_to(statuses, last_stamp);
  std::cout << last.frames_tracked << " tracked, " << last.frames_skipped << " skipped, " << last.frames_missing
            << " missing\n";
  EXPECT_EQ(last.frames_tracked + last.frames_skipped + last.frames_missing, std::uint64_t{kFrames});
  EXPECT_EQ(last.frames_received + last.frames_missing, std::uint64_t{kFrames});
  EXPECT_EQ(last.frame, kFrames - 1u);
  // The mesh belongs to the first, and there is none that is newer than the last.
  EXPECT_GE(last.frames_tracked, 2u);
  EXPECT_GT(last.frames_skipped, 0u);
}

// A tracker that does not read, and more bytes than sockets hold.
TEST(CountedFrames, WhatRoscppDropsIsMissing) {
  constexpr int kFrames = 60;
  constexpr std::size_t kPadding = 1000000;
  Collector<TrackerStatus> statuses("/held_up/status");
  ASSERT_TRUE(statuses.wait_for_publisher());
  const ros::Publisher publisher = ros::NodeHandle().advertise<sensor_msgs::PointCloud2>("held_up/particles", 1);
  ASSERT_TRUE(wait_until([&] { return publisher.getNumSubscribers() == 1; }));
  publisher.publish(ball_cloud(0));
  ASSERT_EQ(answer_to(statuses, ball_cloud(0)->header.stamp).state, TrackerStatus::STARTED);
  const pid_t tracker = process_of("/held_up");
  ASSERT_NE(tracker, 0);
  ASSERT_EQ(kill(tracker, SIGSTOP), 0);
  for (int n = 1; n < kFrames; ++n) {
    const auto cloud = ball_cloud(n);
    cloud->row_step += kPadding;
    cloud->data.resize(cloud->row_step);
    publisher.publish(cloud);
  }
  ASSERT_EQ(kill(tracker, SIGCONT), 0);
  const TrackerStatus last = answer_to(statuses, ball_cloud(kFrames - 1)->header.stamp);
  std::cout << last.frames_received << " received, " << last.frames_missing << " missing\n";
  EXPECT_EQ(last.frames_received + last.frames_missing, std::uint64_t{kFrames});
  EXPECT_EQ(last.frames_tracked, last.frames_received);
  EXPECT_EQ(last.frame, kFrames - 1u);
  EXPECT_GT(last.frames_missing, 0u);
}

}  // namespace
}  // namespace particle_surface_tracker::test
