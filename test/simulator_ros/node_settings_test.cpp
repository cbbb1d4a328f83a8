#include "node_settings.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ros/ros.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker::simulator {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class NodeSettingsTest : public testing::Test {
 protected:
  void TearDown() override { ros::param::del("~"); }

  std::string error() const {
    try {
      read_node_settings(handle_);
    } catch (const ParameterError& error) {
      return error.what();
    }
    return "no ParameterError";
  }

  template <class Value>
  std::string error_with(const std::string& name, const Value& value) {
    handle_.setParam(name, value);
    std::string found = error();
    handle_.deleteParam(name);
    return found;
  }

  ros::NodeHandle handle_{"~"};
};

TEST_F(NodeSettingsTest, NothingIsRequired) {
  const NodeSettings settings = read_node_settings(handle_);
  EXPECT_EQ(settings.simulation.frames, 130);
  EXPECT_EQ(settings.simulation.parameters.spacing, 0.03);
  EXPECT_FALSE(settings.wall_time);
  EXPECT_THAT(settings.wait_for, IsEmpty());
}

TEST_F(NodeSettingsTest, ReadsEveryParameter) {
  handle_.setParam("frames", 7);
  handle_.setParam("start_time", 5);
  handle_.setParam("frame_id", "tank");
  handle_.setParam("mesh_out", "/tmp/ring.ply");
  handle_.setParam("time", "wall");
  handle_.setParam("wait_for", " viewer  /other/recorder ");
  handle_.setParam("max_ahead", 2);
  handle_.setParam("timeout", 1.5);
  double value = 0.5;
  for (const auto& [info, field] : simulator_parameter_table()) handle_.setParam(info.name, value += 0.125);
  const NodeSettings settings = read_node_settings(handle_);
  EXPECT_EQ(settings.simulation.frames, 7);
  EXPECT_EQ(settings.simulation.start_time, 5.0);
  EXPECT_EQ(settings.simulation.frame_id, "tank");
  EXPECT_EQ(settings.mesh_out, "/tmp/ring.ply");
  EXPECT_TRUE(settings.wall_time);
  EXPECT_THAT(settings.wait_for, ElementsAre("/viewer", "/other/recorder"));
  EXPECT_EQ(settings.max_ahead, 2);
  EXPECT_EQ(settings.timeout, 1.5);
  value = 0.5;
  for (const auto& [info, field] : simulator_parameter_table()) {
    EXPECT_EQ(settings.simulation.parameters.*field, value += 0.125) << info.name;
  }
}

TEST_F(NodeSettingsTest, SaysWhatIsWrong) {
  EXPECT_EQ(error(), "no ParameterError");
  EXPECT_THAT(error_with("frames", 0), HasSubstr("~frames is '0'"));
  EXPECT_THAT(error_with("frames", "many"), HasSubstr("~frames is 'many'"));
  EXPECT_THAT(error_with("start_time", -1.0), HasSubstr("start_time is -1 s"));
  EXPECT_THAT(error_with("viscosity", "thick"), HasSubstr("~viscosity is 'thick'"));
  EXPECT_THAT(error_with("time", "now"), HasSubstr("~time is 'now'; it must be one of: simulated, wall"));
  EXPECT_THAT(error_with("wait_for", "good b@d"), HasSubstr("~wait_for has 'b@d'"));
  EXPECT_THAT(error_with("max_ahead", -1), HasSubstr("~max_ahead is '-1'"));
  EXPECT_THAT(error_with("timeout", -1), HasSubstr("~timeout is '-1'"));
  EXPECT_THAT(error_with("viscosty", 0.1), HasSubstr("no parameter ~viscosty"));
}

}  // namespace
}  // namespace particle_surface_tracker::simulator

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "node_settings_test");
  const ros::NodeHandle handle;
  return RUN_ALL_TESTS();
}
