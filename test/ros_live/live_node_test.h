#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "ros_live/live_node.h"
#include "support/temporary_folder.h"

namespace particle_surface_tracker::test {

/// Tests of nodelets in a real manager, in this process.
class LiveNodeTest : public testing::Test {
 protected:
  LiveNodeTest();

  /// A node with a name of its own.
  std::unique_ptr<LiveNode> load(const std::map<std::string, std::string>& parameters = {}) const;

  static nodelet::Loader& manager();

  /// Makes of clouds the meshes that the node has to make.
  static FrameHandler handler();

  TemporaryFolder folder_;
  std::string mesh_;  ///< File of the ball's mesh.
};

/// Frame n of the ball, changed.
sensor_msgs::PointCloud2Ptr changed(int n, const std::function<void(sensor_msgs::PointCloud2&)>& change);

/// Calls a service without data.
void call_reset(const LiveNode& node);

/// The main() of such tests: they need a master.
int run_live_tests(int argc, char** argv);

}  // namespace particle_surface_tracker::test
