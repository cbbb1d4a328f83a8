// What the live node tells /diagnostics.

#include <map>
#include <string>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <std_srvs/SetBool.h>

#include "ros_live/live_node_test.h"
#include "ros_live/reconfigure.h"

namespace particle_surface_tracker::test {
namespace {

using diagnostic_msgs::DiagnosticArray;
using diagnostic_msgs::DiagnosticStatus;

class LiveDiagnostics : public LiveNodeTest {
 protected:
  std::unique_ptr<LiveNode> load_quick(std::map<std::string, std::string> parameters = {}) const {
    parameters.emplace("diagnostic_period", "0.3");
    parameters.emplace("late_after", "1000");  // The machine may be busy.
    return load(parameters);
  }

  /// Waits for one of the three parts of a node's diagnostics, at a level.
  bool comes(const LiveNode& node, const std::string& part, int level, const std::string& words = "") {
    const std::string name = node.name().substr(1) + ": " + part;
    const std::size_t seen = diagnostics_.wait_for(0).size();
    return wait_until([&] {
      const auto all = diagnostics_.wait_for(0);
      for (std::size_t n = seen; n < all.size(); ++n) {
        for (const DiagnosticStatus& status : all[n]->status) {
          if (status.name != name || status.level != level) continue;
          if (status.message.find(words) == std::string::npos) continue;
          last_ = status;
          return true;
        }
      }
      return false;
    });
  }

  /// A value of what came last; empty if it has none of that name.
  std::string value(const std::string& key) const {
    for (const auto& pair : last_.values) {
      if (pair.key == key) return pair.value;
    }
    return "";
  }

  Collector<DiagnosticArray> diagnostics_{"/diagnostics"};
  DiagnosticStatus last_;
};

TEST_F(LiveDiagnostics, SayHowItGoes) {
  const auto node = load_quick();
  for (int n = 0; n < 3; ++n) node->answer(n);
  ASSERT_TRUE(
      wait_until([&] { return comes(*node, "tracking", DiagnosticStatus::OK) && value("frames tracked") == "3"; }));
  EXPECT_EQ(value("runs"), "1");
  EXPECT_EQ(value("frames that wait"), "0");
  EXPECT_GT(std::stod(value("memory of the process [MB]")), 1.0);
  node->answer(3);
  ASSERT_TRUE(comes(*node, "surface", DiagnosticStatus::OK));
  EXPECT_EQ(value("components"), "1");
  EXPECT_EQ(value("splits"), "0");
  EXPECT_EQ(value("triangles"), std::to_string(ball_mesh().triangle_count()));
  EXPECT_GT(std::stod(value("smallest angle [deg]")), 10.0);
}

TEST_F(LiveDiagnostics, TimeIsSaidPerStage) {
  const auto node = load_quick();
  // Until one of the messages has seen frames in its interval.
  int n = 0;
  ASSERT_TRUE(wait_until([&] {
    node->answer(n++);
    return comes(*node, "tracking", DiagnosticStatus::OK) && !value("time of advection [s]").empty();
  }));
  EXPECT_GT(std::stod(value("time of a frame [s]")), 0.0);
  EXPECT_GT(std::stod(value("longest latency [s]")), 0.0);
}

TEST_F(LiveDiagnostics, SayWhatWaitsForAReset) {
  const auto node = load_quick();
  Reconfigure reconfigure(node->name());
  const auto waits = [&](const std::string& words) {
    return wait_until(
        [&] { return comes(*node, "tracking", DiagnosticStatus::OK) && value("waits for reset") == words; });
  };
  // Before there is a mesh nothing has to wait.
  reconfigure.set("dx_gamma", 0.6);
  node->answer(0);
  EXPECT_TRUE(waits("nothing"));
  reconfigure.set("dx_phi", 0.75);
  reconfigure.set("tau", 0.6);
  EXPECT_TRUE(waits("dx_phi 0.5 -> 0.75"));
  reconfigure.set("dx_gamma", 0.5);
  EXPECT_TRUE(waits("dx_phi 0.5 -> 0.75, dx_gamma 0.6 -> 0.5"));
  call_reset(*node);
  EXPECT_TRUE(waits("nothing"));
  EXPECT_EQ(node->answer(1).state, TrackerStatus::STARTED);
  EXPECT_TRUE(waits("nothing"));
}

TEST_F(LiveDiagnostics, CountWhatIsDroppedDuringAPause) {
  const auto node = load_quick({{"queue_size", "2"}});
  node->answer(0);
  std_srvs::SetBool pause;
  pause.request.data = 1;
  ASSERT_TRUE(ros::service::call(node->name() + "/pause", pause));
  ASSERT_TRUE(comes(*node, "tracking", DiagnosticStatus::WARN, "paused"));
  for (int n = 1; n < 8; ++n) node->send(n);
  // They may be spread over several intervals; the count is that of all.
  EXPECT_TRUE(wait_until(
      [&] { return comes(*node, "input", DiagnosticStatus::WARN, "dropped") && value("frames dropped") == "5"; }));
}

TEST_F(LiveDiagnostics, WarnOfWhatIsLost) {
  const auto node = load_quick();
  for (const int n : {0, 1, 2}) node->answer(n);
  node->send(6);
  EXPECT_TRUE(comes(*node, "input", DiagnosticStatus::WARN, "3 missing"));
  EXPECT_EQ(value("frames missing"), "3");
  // The next interval is good again.
  node->answer(7);
  EXPECT_TRUE(comes(*node, "input", DiagnosticStatus::OK));
}

TEST_F(LiveDiagnostics, WarnOfDelay) {
  const auto node = load_quick({{"late_after", "0"}});
  node->send(0);
  EXPECT_TRUE(comes(*node, "tracking", DiagnosticStatus::WARN, "late by"));
}

TEST_F(LiveDiagnostics, WarnOfAPause) {
  const auto node = load_quick();
  node->answer(0);
  std_srvs::SetBool pause;
  pause.request.data = 1;
  ASSERT_TRUE(ros::service::call(node->name() + "/pause", pause));
  EXPECT_TRUE(comes(*node, "tracking", DiagnosticStatus::WARN, "paused"));
}

TEST_F(LiveDiagnostics, SilenceIsStale) {
  const auto node = load_quick();
  node->answer(0);
  EXPECT_TRUE(comes(*node, "input", DiagnosticStatus::STALE, "no particles"));
}

TEST_F(LiveDiagnostics, AGapIsAnErrorUntilTheReset) {
  const auto node = load_quick({{"queue_policy", "strict"}});
  for (const int n : {0, 1, 3}) node->answer(n);
  EXPECT_TRUE(comes(*node, "tracking", DiagnosticStatus::ERROR, "1 frame is missing"));
  // Also when nothing arrives any more.
  EXPECT_TRUE(comes(*node, "tracking", DiagnosticStatus::ERROR, "1 frame is missing"));
  EXPECT_TRUE(comes(*node, "tracking", DiagnosticStatus::ERROR, "1 frame is missing"));
  call_reset(*node);
  EXPECT_TRUE(comes(*node, "tracking", DiagnosticStatus::OK));
}

}  // namespace
}  // namespace particle_surface_tracker::test
