// Queue policies of the live node: what becomes of frames that arrive too fast, or are lost.

#include <algorithm>
#include <string>

#include <gtest/gtest.h>
#include <rosgraph_msgs/Log.h>

#include "ros_live/live_node_test.h"

namespace particle_surface_tracker::test {
namespace {

using sensor_msgs::PointCloud2;
using State = TrackerStatus;

class LivePolicies : public LiveNodeTest {};

TEST_F(LivePolicies, FullQueueDropsWhatArrivesAndAnswersAll) {
  const auto node = load({{"queue_size", "1"}});
  for (int n = 0; n < 60; ++n) node->send(n);
  const auto all = node->statuses().wait_for(60);
  ASSERT_EQ(all.size(), 60u);
  const State last = *all.back();
  EXPECT_EQ(all.front()->state, State::STARTED);
  EXPECT_GT(last.frames_dropped, 0u);
  EXPECT_EQ(last.frames_received, all.size());
  EXPECT_EQ(last.frames_tracked + last.frames_dropped, all.size());
  for (const auto& status : all) {
    if (status->state != State::DROPPED) continue;
    EXPECT_NE(status->reason.find("queue_size is 1"), std::string::npos) << status->reason;
  }
  EXPECT_EQ(node->answer(60).state, State::TRACKED);
}

TEST_F(LivePolicies, PolicyLatestSkipsToTheNewest) {
  const auto node = load({{"queue_policy", "latest"}});
  for (int n = 0; n < 40; ++n) node->send(n);
  const auto all = node->statuses().wait_for(40);
  ASSERT_EQ(all.size(), 40u);
  EXPECT_EQ(all.back()->state, State::TRACKED);
  EXPECT_EQ(all.back()->frame, 39u);
  // The mesh belongs to the first frame: that one is not skipped.
  EXPECT_EQ(all.front()->state, State::STARTED);
  EXPECT_EQ(all.front()->header.stamp, ball_cloud(0)->header.stamp);
  EXPECT_GT(all.back()->frames_skipped, 0u);
  EXPECT_EQ(all.back()->frames_skipped + all.back()->frames_tracked, 40u);
}

bool has(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

std::size_t errors_of(Collector<rosgraph_msgs::Log>& log, const std::string& words) {
  const auto lines = log.wait_for(0);
  return static_cast<std::size_t>(std::count_if(lines.begin(), lines.end(), [&](const auto& line) {
    return line->level == rosgraph_msgs::Log::ERROR && has(line->msg, words);
  }));
}

TEST_F(LivePolicies, StrictTracksWhatHasNoGaps) {
  const auto node = load({{"queue_policy", "strict"}});
  for (int n = 0; n < 5; ++n) EXPECT_EQ(node->answer(n).state, n == 0 ? State::STARTED : State::TRACKED);
  // A frame that comes twice is no gap, nor is a run that begins again.
  EXPECT_EQ(node->answer(4).state, State::SKIPPED);
  EXPECT_EQ(node->answer(5).state, State::TRACKED);
  EXPECT_EQ(node->answer(0).state, State::STARTED);
}

TEST_F(LivePolicies, StrictRefusesAllAfterAGapInTheSequenceUntilTheReset) {
  Collector<rosgraph_msgs::Log> log("/rosout");
  const auto node = load({{"queue_policy", "strict"}});
  for (const int n : {0, 1, 2}) node->answer(n);
  const State gap = node->answer(4);
  EXPECT_EQ(gap.state, State::FAILED);
  EXPECT_TRUE(has(gap.reason, "1 frame is missing")) << gap.reason;
  EXPECT_TRUE(has(gap.reason, "~reset")) << gap.reason;
  EXPECT_EQ(gap.frames_missing, 1u);
  // Also the next ones, one that begins again and one that is bad.
  for (const int n : {5, 6, 0, 1}) EXPECT_EQ(node->answer(n).state, State::FAILED) << n;
  EXPECT_EQ(node->answer(changed(2, [](PointCloud2& cloud) { cloud.data.clear(); })).frames_failed, 6u);
  // The last mesh is still there for whoever asks.
  Collector<TrackedMesh> late(node->name() + "/mesh");
  ASSERT_EQ(late.wait_for(1).size(), 1u);
  EXPECT_EQ(late.wait_for(1)[0]->header.stamp, ball_cloud(2)->header.stamp);
  ASSERT_TRUE(wait_until([&] { return errors_of(log, node->name() + ": a gap in the input") > 0; }));
  EXPECT_EQ(errors_of(log, node->name()), 1u);

  call_reset(*node);
  EXPECT_EQ(node->answer(7).state, State::STARTED);
  EXPECT_EQ(node->answer(8).state, State::TRACKED);
}

TEST_F(LivePolicies, StrictFindsAGapByTheStamps) {
  const auto node = load({{"queue_policy", "strict"}});
  const auto uncounted = [](int n) { return changed(n, [](PointCloud2& cloud) { cloud.header.seq = 0; }); };
  // In one process roscpp keeps the numbers that a publisher gives; these are all the same.
  for (int n = 0; n < 6; ++n) EXPECT_NE(node->answer(uncounted(n)).state, State::FAILED) << n;
  EXPECT_EQ(node->answer(uncounted(9)).state, State::FAILED);
}

// A publisher that restarts counts from the beginning, while the stamps go on.
TEST_F(LivePolicies, StrictGoesOnWithAPublisherThatRestarts) {
  const auto node = load({{"queue_policy", "strict"}});
  const auto numbered = [](int n, std::uint32_t seq) {
    return changed(n, [seq](PointCloud2& cloud) { cloud.header.seq = seq; });
  };
  for (int n = 0; n < 6; ++n) EXPECT_LE(node->answer(numbered(n, 100 + n)).state, State::TRACKED) << n;
  for (int n = 6; n < 9; ++n) {
    const State status = node->answer(numbered(n, n - 6));
    EXPECT_EQ(status.state, State::TRACKED) << n << ": " << status.reason;
    EXPECT_EQ(status.frames_missing, 0u) << n;
    EXPECT_EQ(status.frame, static_cast<std::uint64_t>(n));
  }
  // The new numbers are relied on as the old ones were,
  const State gap = node->answer(numbered(11, 5));
  EXPECT_EQ(gap.state, State::FAILED);
  EXPECT_TRUE(has(gap.reason, "2 frames are missing")) << gap.reason;
  // and what is lost while it restarts is found by the stamps.
  call_reset(*node);
  for (int n = 12; n < 18; ++n) EXPECT_LE(node->answer(numbered(n, 100 + n)).state, State::TRACKED) << n;
  const State restart = node->answer(numbered(21, 0));
  EXPECT_EQ(restart.state, State::FAILED);
  EXPECT_TRUE(has(restart.reason, "3 frames are missing")) << restart.reason;
}

TEST_F(LivePolicies, StrictTakesAFullQueueForAGap) {
  const auto node = load({{"queue_policy", "strict"}, {"queue_size", "1"}});
  for (int n = 0; n < 60; ++n) node->send(n);
  const auto all = node->statuses().wait_for(60);
  ASSERT_EQ(all.size(), 60u);
  const State last = *all.back();
  EXPECT_EQ(last.state, State::FAILED);
  EXPECT_TRUE(has(last.reason, "the queue is full (queue_size is 1)")) << last.reason;
  EXPECT_EQ(last.frames_tracked + last.frames_failed, 60u);
  // What came before the gap is tracked, all of it and nothing else.
  for (std::size_t n = 0; n < 60; ++n) EXPECT_EQ(all[n]->state == State::FAILED, n >= last.frames_tracked) << n;
  EXPECT_EQ(all.front()->state, State::STARTED);
}

TEST_F(LivePolicies, StrictTakesABadCloudForAGap) {
  const auto node = load({{"queue_policy", "strict"}});
  const auto bad = [](PointCloud2& cloud) { cloud.data.clear(); };
  // There is no mesh yet that could miss anything.
  EXPECT_EQ(node->answer(changed(0, bad)).state, State::INVALID);
  EXPECT_EQ(node->answer(1).state, State::STARTED);
  EXPECT_EQ(node->answer(changed(2, bad)).state, State::INVALID);
  const State next = node->answer(3);
  EXPECT_EQ(next.state, State::FAILED);
  EXPECT_TRUE(has(next.reason, "could not be tracked")) << next.reason;
}

}  // namespace
}  // namespace particle_surface_tracker::test
