// Listens to demo.launch: every frame of the simulator is tracked, by a nodelet in a manager.

#include <functional>
#include <vector>

#include <gtest/gtest.h>
#include <particle_surface_tracker/TrackedMesh.h>
#include <particle_surface_tracker/TrackerStatus.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>

namespace particle_surface_tracker {
namespace {

constexpr std::size_t kFrames = 8;
const ros::WallDuration kLongEnough(120.0);

bool spin_until(const std::function<bool()>& done) {
  const ros::WallTime end = ros::WallTime::now() + kLongEnough;
  while (!done() && ros::WallTime::now() < end) {
    ros::spinOnce();
    ros::WallDuration(0.01).sleep();
  }
  return done();
}

template <class Message>
class Received {
 public:
  Received(ros::NodeHandle& handle, const char* topic)
      : subscriber_(handle.subscribe<Message>(
            topic, kFrames, [this](const boost::shared_ptr<const Message>& message) { messages.push_back(message); })) {
  }

  bool is_connected() const { return subscriber_.getNumPublishers() > 0; }

  std::vector<boost::shared_ptr<const Message>> messages;

 private:
  ros::Subscriber subscriber_;
};

TEST(DemoLaunch, EveryFrameIsTracked) {
  ros::NodeHandle handle;
  const Received<TrackerStatus> statuses(handle, "tracker/status");
  const Received<TrackedMesh> meshes(handle, "tracker/mesh");
  ASSERT_TRUE(spin_until([&] { return statuses.is_connected() && meshes.is_connected(); })) << "no nodelet";
  const Received<sensor_msgs::PointCloud2> clouds(handle, "particles");
  ASSERT_TRUE(spin_until([&] { return statuses.messages.size() == kFrames && meshes.messages.size() == kFrames; }))
      << statuses.messages.size() << " statuses, " << meshes.messages.size() << " meshes";
  ASSERT_EQ(clouds.messages.size(), kFrames);
  for (std::size_t frame = 0; frame < kFrames; ++frame) {
    const TrackerStatus& status = *statuses.messages[frame];
    EXPECT_EQ(status.state, frame == 0 ? TrackerStatus::STARTED : TrackerStatus::TRACKED) << status.reason;
    EXPECT_EQ(status.header.stamp, clouds.messages[frame]->header.stamp);
    EXPECT_EQ(meshes.messages[frame]->header.stamp, status.header.stamp);
    EXPECT_EQ(meshes.messages[frame]->header.frame_id, "world");
    EXPECT_EQ(status.frames_missing, 0U);
  }
}

}  // namespace
}  // namespace particle_surface_tracker

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "demo_launch_test");
  return RUN_ALL_TESTS();
}
