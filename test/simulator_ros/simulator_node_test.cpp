// Plays the tracker to a simulator_node: what it publishes, and that it waits.

#include <functional>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <particle_surface_tracker/TrackerStatus.h>
#include <ros/ros.h>
#include <visualization_msgs/MarkerArray.h>

#include "audience.h"
#include "simulation.h"

namespace particle_surface_tracker::simulator {
namespace {

const ros::WallDuration kLongEnough(20.0);

// Handles callbacks until `done` or the time is over.
bool spin_until(const std::function<bool()>& done, const ros::WallDuration& limit = kLongEnough) {
  const ros::WallTime end = ros::WallTime::now() + limit;
  while (!done() && ros::WallTime::now() < end) {
    ros::spinOnce();
    ros::WallDuration(0.01).sleep();
  }
  return done();
}

class Listener {
 public:
  Listener() {
    status_ = handle_.advertise<TrackerStatus>("status", 10);
    tank_ = handle_.subscribe<visualization_msgs::MarkerArray>(
        "simulator/tank", 1, [this](const visualization_msgs::MarkerArrayConstPtr& message) { tank = message; });
    particles_ = handle_.subscribe<sensor_msgs::PointCloud2>(
        "particles", 10, [this](const sensor_msgs::PointCloud2ConstPtr& cloud) { clouds.push_back(cloud); });
  }

  void report(std::size_t frame) {
    TrackerStatus status;
    status.header = clouds[frame]->header;
    status_.publish(status);
  }

  std::vector<sensor_msgs::PointCloud2ConstPtr> clouds;
  visualization_msgs::MarkerArrayConstPtr tank;

 private:
  ros::NodeHandle handle_;
  ros::Publisher status_;
  ros::Subscriber tank_;
  ros::Subscriber particles_;
};

TEST(SimulatorNode, PublishesEveryFrameAndWaitsForTheTracker) {
  Listener listener;
  const auto has = [&](std::size_t count) { return [&listener, count] { return listener.clouds.size() >= count; }; };
  ASSERT_TRUE(spin_until(has(2)));
  EXPECT_FALSE(spin_until(has(3), ros::WallDuration(1.0))) << "two frames ahead, and nothing was reported";
  listener.report(0);
  ASSERT_TRUE(spin_until(has(3)));
  EXPECT_FALSE(spin_until(has(4), ros::WallDuration(1.0)));
  listener.report(2);
  ASSERT_TRUE(spin_until(has(5)));

  SimulationSettings settings;
  settings.frames = 5;
  settings.parameters.spacing = 0.06;
  settings.start_time = 20.0;
  Simulation simulation(settings);
  for (const sensor_msgs::PointCloud2ConstPtr& cloud : listener.clouds) {
    const sensor_msgs::PointCloud2ConstPtr expected = simulation.cloud();
    EXPECT_EQ(cloud->header.stamp, expected->header.stamp);
    EXPECT_EQ(cloud->header.frame_id, "world");
    EXPECT_EQ(cloud->data, expected->data);
    simulation.advance();
  }
  EXPECT_TRUE(spin_until([&] { return ros::Time::now() == listener.clouds.back()->header.stamp; })) << "the clock";
  ASSERT_TRUE(spin_until([&] { return listener.tank != nullptr; }));
  EXPECT_EQ(listener.tank->markers.size(), 2U) << "floor and ball";
}

TEST(Audience, NamesThoseWhoAreMissing) {
  Audience anyone({});
  EXPECT_FALSE(anyone.is_complete());
  EXPECT_EQ(anyone.missing(), "any subscriber");
  EXPECT_EQ(Audience({"/b", "/a"}).missing(), "/a and /b");
}

}  // namespace
}  // namespace particle_surface_tracker::simulator

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "simulator_node_test");
  const ros::NodeHandle handle;
  return RUN_ALL_TESTS();
}
