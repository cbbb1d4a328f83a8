#include "ros_live/live_node_test.h"

#include <std_srvs/Trigger.h>

#include "particle_surface_tracker/io/mesh_writer.h"

namespace particle_surface_tracker::test {
namespace {

nodelet::Loader* the_manager = nullptr;  // Of run_live_tests().

std::string next_name() {
  static int count = 0;
  return "/tracker_" + std::to_string(++count);
}

}  // namespace

LiveNodeTest::LiveNodeTest() : mesh_(folder_ / "ball.ply") {
  write_ply(mesh_, ball_mesh());
}

std::unique_ptr<LiveNode> LiveNodeTest::load(const std::map<std::string, std::string>& parameters) const {
  return std::make_unique<LiveNode>(manager(), next_name(), mesh_, parameters);
}

nodelet::Loader& LiveNodeTest::manager() {
  return *the_manager;
}

FrameHandler LiveNodeTest::handler() {
  FrameHandlerOptions options;
  options.parameters.particle_spacing = kBallSpacing;
  options.mesh = ball_mesh();
  return FrameHandler(options);
}

sensor_msgs::PointCloud2Ptr changed(int n, const std::function<void(sensor_msgs::PointCloud2&)>& change) {
  sensor_msgs::PointCloud2Ptr cloud = ball_cloud(n);
  change(*cloud);
  return cloud;
}

void call_reset(const LiveNode& node) {
  std_srvs::Trigger reset;
  ASSERT_TRUE(ros::service::call(node.name() + "/reset", reset));
  EXPECT_TRUE(reset.response.success);
  EXPECT_FALSE(reset.response.message.empty());
}

int run_live_tests(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "live_node_test");
  ros::AsyncSpinner spinner(2);
  spinner.start();
  nodelet::Loader manager(/*provide_ros_api*/ false);
  the_manager = &manager;
  const int result = RUN_ALL_TESTS();
  the_manager = nullptr;
  return result;
}

}  // namespace particle_surface_tracker::test
