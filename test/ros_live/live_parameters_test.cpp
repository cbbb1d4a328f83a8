// Parameters of the live node: at the start, with dynamic_reconfigure, and bad ones.

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <gtest/gtest.h>
#include <rosgraph_msgs/Log.h>

#include "ros/ros_test_support.h"
#include "ros_live/live_node_test.h"
#include "ros_live/reconfigure.h"

namespace particle_surface_tracker::test {
namespace {

using State = TrackerStatus;

class LiveParameters : public LiveNodeTest {};

TEST_F(LiveParameters, ParametersOfTheStartAreShownWithTheirRanges) {
  const auto node = load({{"tau", "0.7"}, {"projection", "one_step"}});
  Collector<dynamic_reconfigure::Config> updates(node->name() + "/parameter_updates");
  ASSERT_GE(updates.wait_for(1).size(), 1u);
  EXPECT_EQ(value_of<double>(*updates.wait_for(1).back(), "tau"), 0.7);
  EXPECT_EQ(value_of<std::string>(*updates.wait_for(1).back(), "projection"), "one_step");
  Collector<dynamic_reconfigure::ConfigDescription> descriptions(node->name() + "/parameter_descriptions");
  ASSERT_GE(descriptions.wait_for(1).size(), 1u);
  const auto description = descriptions.wait_for(1).back();
  for (const ParameterInfo& info : parameter_table()) {
    if (info.name == "particle_spacing" || info.type != ParameterInfo::Type::kReal) continue;
    EXPECT_EQ(value_of<double>(description->min, info.name), info.minimum) << info.name;
    EXPECT_EQ(value_of<double>(description->max, info.name), info.slider_maximum) << info.name;
  }
}

TEST_F(LiveParameters, ValuesBeyondTheSlidersAreShownAndTakenAsTheyAre) {
  const auto node = load({{"tau", "50.0"}});
  Reconfigure reconfigure(node->name());
  EXPECT_EQ(value_of<double>(*reconfigure.updates().wait_for(1).back(), "tau"), 50.0);
  node->answer(0);
  // Another parameter changes; this one stays.
  EXPECT_EQ(value_of<double>(reconfigure.set("epsilon", 0.5), "tau"), 50.0);
  EXPECT_EQ(value_of<double>(reconfigure.set("max_displacement", 1e5), "max_displacement"), 1e5);
  EXPECT_EQ(value_of<int>(reconfigure.set("projection_max_steps", 5000), "projection_max_steps"), 5000);
  EXPECT_EQ(value_of<double>(reconfigure.set("tau", 60.0), "tau"), 60.0);
}

TEST_F(LiveParameters, ReconfiguredValuesAreAppliedBetweenFrames) {
  const auto node = load();
  Collector<TrackedMesh> meshes(node->name() + "/mesh");
  ASSERT_TRUE(meshes.wait_for_publisher());
  Reconfigure reconfigure(node->name());
  node->answer(0);
  EXPECT_EQ(value_of<std::string>(reconfigure.set("advection", std::string("average")), "advection"), "average");
  node->answer(1);
  FrameHandler offline = handler();
  offline.handle(*ball_cloud(0), 0);
  Parameters parameters;
  parameters.particle_spacing = kBallSpacing;
  parameters.advection = AdvectionMethod::kAverage;
  EXPECT_TRUE(offline.set_parameters(parameters).empty());
  offline.handle(*ball_cloud(1), 1);
  ASSERT_EQ(meshes.wait_for(2).size(), 2u);
  EXPECT_EQ(bytes_of(*meshes.wait_for(2)[1]), bytes_of(offline.message()));
}

TEST_F(LiveParameters, RefusedValuesAreSaidAndTheOldOnesShown) {
  Collector<rosgraph_msgs::Log> log("/rosout");
  const auto node = load();
  Reconfigure reconfigure(node->name());
  node->answer(0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(value_of<double>(reconfigure.set("tau", 1e9), "tau"), 0.5);
  EXPECT_EQ(value_of<double>(reconfigure.set("tau", nan), "tau"), 0.5);
  EXPECT_EQ(value_of<std::string>(reconfigure.set("advection", std::string("guess")), "advection"), "affine");
  EXPECT_EQ(value_of<int>(reconfigure.set("projection_max_steps", 0), "projection_max_steps"), 100);
  EXPECT_EQ(value_of<double>(reconfigure.set("affine_max_radius", 1.0), "affine_max_radius"), 4.0);
  EXPECT_EQ(value_of<double>(*reconfigure.updates().wait_for(1).back(), "tau"), 0.5);
  EXPECT_TRUE(wait_until([&] {
    const auto lines = log.wait_for(0);
    return std::any_of(lines.begin(), lines.end(), [&](const auto& line) {
      return line->level == rosgraph_msgs::Log::WARN &&
             line->msg.find(node->name() + ": refused: tau is 1000000000") == 0;
    });
  }));
  EXPECT_EQ(node->answer(1).state, State::TRACKED);
}

TEST_F(LiveParameters, ValuesThatNeedAResetWaitForIt) {
  const auto node = load();
  Collector<TrackedMesh> meshes(node->name() + "/mesh");
  ASSERT_TRUE(meshes.wait_for_publisher());
  Reconfigure reconfigure(node->name());
  FrameHandler unchanged = handler();
  node->answer(0);
  reconfigure.set("dx_phi", 0.25);
  node->answer(1);
  unchanged.handle(*ball_cloud(0), 0);
  unchanged.handle(*ball_cloud(1), 1);
  EXPECT_EQ(bytes_of(*meshes.wait_for(2).at(1)), bytes_of(unchanged.message()));

  node->answer(0);  // The time goes back.
  FrameHandlerOptions options;
  options.parameters.particle_spacing = kBallSpacing;
  options.parameters.dx_phi = 0.25;
  options.mesh = ball_mesh();
  FrameHandler finer(options);
  finer.handle(*ball_cloud(0), 0);
  EXPECT_EQ(meshes.wait_for(3).at(2)->delta, finer.message().delta);
  EXPECT_NE(meshes.wait_for(3).at(2)->delta, meshes.wait_for(3).at(0)->delta);
}

XmlRpc::XmlRpcValue on_server(const std::string& name) {
  XmlRpc::XmlRpcValue value;
  ros::param::get(name, value);
  return value;
}

double tau_of(const std::string& node) {
  Collector<dynamic_reconfigure::Config> updates(node + "/parameter_updates");
  const auto received = updates.wait_for(1);
  return received.empty() ? 0.0 : value_of<double>(*received.back(), "tau");
}

TEST_F(LiveParameters, ANodeThatEndsInOrderLeavesTheServerAsItWas) {
  auto node = load({{"tau", "0.7"}});
  const std::string name = node->name();
  Reconfigure(name).set("tau", 0.3);
  Reconfigure(name).set("beta", 0.02);
  EXPECT_EQ(on_server(name).size(), 4 + static_cast<int>(parameter_table().size()) - 2);
  ros::param::set(name + "/dx_phi", 0.6);  // Somebody else writes it, for the next start.
  node.reset();
  XmlRpc::XmlRpcValue left = on_server(name);
  ASSERT_EQ(left.size(), 4);
  EXPECT_TRUE(left.hasMember("mesh"));
  EXPECT_TRUE(left.hasMember("spacing"));
  EXPECT_EQ(static_cast<std::string>(left["tau"]), "0.7");
  EXPECT_EQ(static_cast<double>(left["dx_phi"]), 0.6);
}

TEST_F(LiveParameters, AnotherConfigHoldsAtTheNextStart) {
  const std::string one = folder_.write("one.yaml", "tau: 0.9\n");
  const std::string two = folder_.write("two.yaml", "tau: 0.25\n");
  const std::string name = "/configured";
  const auto start = [&](const std::string& config) {
    ros::param::set(name + "/config", config);
    return manager().load(name, "particle_surface_tracker/TrackerNodelet", {}, {});
  };
  ros::param::set(name + "/spacing", kBallSpacing);
  ASSERT_TRUE(start(one));
  EXPECT_EQ(tau_of(name), 0.9);
  manager().unload(name);
  ASSERT_TRUE(start(two));
  EXPECT_EQ(tau_of(name), 0.25);
  manager().unload(name);
}

TEST_F(LiveParameters, WhatANodeThatDiedHasLeftGivesWayToAChangedConfigOnly) {
  Collector<rosgraph_msgs::Log> log("/rosout");
  ASSERT_TRUE(log.wait_for_publisher());
  const std::string config = folder_.write("some.yaml", "tau: 0.9\nbeta: 0.02\n");
  const std::string name = "/died";
  const auto start = [&] { return manager().load(name, "particle_surface_tracker/TrackerNodelet", {}, {}); };
  const auto said = [&](const std::string& words) {
    return wait_until([&] {
      const auto lines = log.wait_for(0);
      return std::any_of(lines.begin(), lines.end(), [&](const auto& line) {
        return line->msg.find(name + ": ") == 0 && line->msg.find(words) != std::string::npos;
      });
    });
  };
  // What lies on the server after a SIGKILL.
  const auto die = [&] {
    const XmlRpc::XmlRpcValue left = on_server(name);
    manager().unload(name);
    ros::param::set(name, left);
  };
  ros::param::set(name + "/spacing", kBallSpacing);
  ros::param::set(name + "/config", config);
  ros::param::set(name + "/epsilon", 0.5);
  ASSERT_TRUE(start());
  Reconfigure(name).set("tau", 0.7);
  Reconfigure(name).set("beta", 0.03);
  die();
  ASSERT_TRUE(start());
  EXPECT_EQ(tau_of(name), 0.7);
  EXPECT_TRUE(said("what dynamic_reconfigure had changed stays so: tau 0.9 -> 0.7, beta 0.02 -> 0.03"));
  die();
  folder_.write("some.yaml", "tau: 0.25\nbeta: 0.02\nepsilon: 0.1\n");
  ASSERT_TRUE(start());
  EXPECT_EQ(tau_of(name), 0.25);
  EXPECT_TRUE(said("~config has changed since, and what it says now holds: tau = 0.25 (not 0.7)"));
  EXPECT_EQ(static_cast<double>(on_server(name + "/beta")), 0.03);
  // What a user gives beside it wins over it, before and after.
  EXPECT_EQ(static_cast<double>(on_server(name + "/epsilon")), 0.5);
  die();
  ros::param::set(name + "/tau", 0.4);
  ASSERT_TRUE(start());
  EXPECT_EQ(tau_of(name), 0.4);
  manager().unload(name);
  EXPECT_EQ(static_cast<double>(on_server(name + "/tau")), 0.4);
  EXPECT_EQ(on_server(name).size(), 4);
}

TEST_F(LiveParameters, NodesThatCannotStartSayWhyAndTheManagerLives) {
  Collector<rosgraph_msgs::Log> log("/rosout");
  const auto said = [&](const std::string& name, const std::string& words) {
    return wait_until([&] {
      const auto lines = log.wait_for(0);
      return std::any_of(lines.begin(), lines.end(), [&](const auto& line) {
        return line->level == rosgraph_msgs::Log::FATAL && line->msg.find(name + ": cannot start: ") == 0 &&
               line->msg.find(words) != std::string::npos;
      });
    });
  };
  ASSERT_TRUE(log.wait_for_publisher());
  write_file(folder_ / "bad.ply", "ply\nnot really");
  write_file(folder_ / "bad.yaml", "tau: 0.5\ntua: 7\n");
  const std::vector<std::pair<std::map<std::string, std::string>, std::string>> cases = {
      {{{"mesh", folder_ / "none.ply"}}, "none.ply"},
      {{{"mesh", folder_ / "bad.ply"}}, "bad.ply"},
      {{{"spacing", "wide"}}, "~spacing is 'wide'"},
      {{{"spacing", "-1"}}, "~spacing is '-1'"},
      {{{"tau", "1e9"}}, "~tau is"},
      {{{"config", folder_ / "bad.yaml"}}, "tua"},
      {{{"queue_size", "0"}}, "~queue_size is '0'"},
      {{{"queue_policy", "some"}}, "all, latest"},
      {{{"refine_initial", "maybe"}}, "true or false"}};
  for (const auto& [parameters, words] : cases) {
    const auto node = load(parameters);
    EXPECT_FALSE(node->loaded()) << words;
    EXPECT_TRUE(said(node->name(), words)) << words;
  }
  const auto node = load();
  ASSERT_TRUE(node->loaded());
  EXPECT_EQ(node->answer(0).state, State::STARTED);
}

TEST_F(LiveParameters, UnknownParametersAreSaid) {
  Collector<rosgraph_msgs::Log> log("/rosout");
  ASSERT_TRUE(log.wait_for_publisher());
  const auto node = load({{"taau", "0.4"}});
  EXPECT_TRUE(node->loaded());
  EXPECT_TRUE(wait_until([&] {
    const auto lines = log.wait_for(0);
    return std::any_of(lines.begin(), lines.end(), [](const auto& line) {
      return line->msg.find("there is no parameter ~taau") != std::string::npos;
    });
  }));
}

}  // namespace
}  // namespace particle_surface_tracker::test
