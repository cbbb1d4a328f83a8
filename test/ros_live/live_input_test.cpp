// What the live node makes of clouds that are bad, late, missing or of another run.

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>

#include <gtest/gtest.h>
#include <rosgraph_msgs/Log.h>

#include "particle_surface_tracker/io/mesh_writer.h"
#include "ros_live/live_node_test.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test {
namespace {

using sensor_msgs::PointCloud2;
using State = TrackerStatus;

class LiveInput : public LiveNodeTest {};

struct BadCloud {
  const char* what;
  std::function<void(PointCloud2&)> change;
  std::vector<std::string> words;
};

std::vector<BadCloud> bad_clouds() {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  return {
      {"NaN", [nan](PointCloud2& cloud) { std::memcpy(cloud.data.data(), &nan, sizeof nan); }, {"finite"}},
      {"same id twice", [](PointCloud2& c) { std::copy_n(&c.data[12], 4, &c.data[12 + c.point_step]); }, {"id"}},
      {"no id", [](PointCloud2& cloud) { cloud.fields[3].name = "label"; }, {"id"}},
      {"id of type float", [](PointCloud2& cloud) { cloud.fields[3].datatype = 7; }, {"id", "FLOAT32", "UINT32"}},
      {"x of type double", [](PointCloud2& cloud) { cloud.fields[0].datatype = 8; }, {"x", "FLOAT64"}},
      {"overlapping fields", [](PointCloud2& cloud) { cloud.fields[3].offset = 10; }, {"id"}},
      {"field beyond the point", [](PointCloud2& cloud) { cloud.fields[3].offset = 14; }, {"id"}},
      {"small point_step", [](PointCloud2& cloud) { cloud.point_step = 8; }, {"point_step"}},
      {"small row_step", [](PointCloud2& cloud) { cloud.row_step -= 1; }, {"row_step"}},
      {"big-endian", [](PointCloud2& cloud) { cloud.is_bigendian = true; }, {"is_bigendian"}},
      {"truncated", [](PointCloud2& cloud) { cloud.data.resize(cloud.data.size() / 2); }, {"bytes"}},
      {"huge width", [](PointCloud2& cloud) { cloud.width = 4000000000u; }, {"row_step"}},
      {"huge width and height", [](PointCloud2& c) { c.width = c.height = 4000000000u; }, {"width"}},
  };
}

TEST_F(LiveInput, BadCloudsAreAnsweredAndTheNextGoodOneIsTracked) {
  const auto node = load();
  int n = 0;
  ASSERT_EQ(node->answer(n++).state, State::STARTED);
  std::uint64_t bad = 0;
  for (const BadCloud& kind : bad_clouds()) {
    const State answer = node->answer(changed(n++, kind.change));
    EXPECT_EQ(answer.state, State::INVALID) << kind.what;
    EXPECT_EQ(answer.frames_invalid, ++bad) << kind.what;
    for (const std::string& word : kind.words) {
      EXPECT_NE(answer.reason.find(word), std::string::npos) << kind.what << ": " << answer.reason;
    }
    const State next = node->answer(n++);
    EXPECT_EQ(next.state, State::TRACKED) << kind.what;
    EXPECT_EQ(next.frames_missing, 0u) << kind.what;
    EXPECT_EQ(next.frame, static_cast<std::uint64_t>(n - 1)) << kind.what;
  }
}

TEST_F(LiveInput, BadFirstCloudsDoNotStart) {
  const auto node = load();
  EXPECT_EQ(node->answer(changed(0, [](PointCloud2& cloud) { cloud.data.clear(); })).state, State::INVALID);
  const State empty = node->answer(changed(1, [](PointCloud2& cloud) {
    cloud.width = cloud.row_step = 0;
    cloud.data.clear();
  }));
  EXPECT_EQ(empty.state, State::INVALID);
  EXPECT_NE(empty.reason.find("no particles"), std::string::npos) << empty.reason;
  EXPECT_EQ(node->answer(2).state, State::STARTED);
}

TEST_F(LiveInput, EmptyCloudInTheMiddleIsTracked) {
  const auto node = load();
  node->answer(0);
  const State empty = node->answer(changed(1, [](PointCloud2& cloud) {
    cloud.width = cloud.row_step = 0;
    cloud.data.clear();
  }));
  EXPECT_EQ(empty.state, State::TRACKED);
  ASSERT_EQ(empty.warnings.size(), 1u);
  EXPECT_EQ(node->answer(2).state, State::TRACKED);
}

TEST_F(LiveInput, MeshAndParticlesThatDoNotBelongTogetherFail) {
  write_ply(mesh_, make_sphere(Vec3d(0, 0, 50), 1.0, 3));
  const auto node = load();
  const State answer = node->answer(0);
  EXPECT_EQ(answer.state, State::FAILED);
  EXPECT_NE(answer.reason.find("246 r"), std::string::npos) << answer.reason;
  EXPECT_EQ(answer.frames_failed, 1u);
}

TEST_F(LiveInput, LoopedInputStartsAgainWithItsMesh) {
  const auto node = load();
  Collector<TrackedMesh> meshes(node->name() + "/mesh");
  ASSERT_TRUE(meshes.wait_for_publisher());
  for (int loop = 0; loop < 3; ++loop) {
    for (int n = 0; n < 4; ++n) {
      const State answer = node->answer(n);
      EXPECT_EQ(answer.state, n == 0 ? State::STARTED : State::TRACKED) << loop << ", " << n;
      EXPECT_EQ(answer.run, static_cast<std::uint32_t>(loop + 1));
      EXPECT_EQ(answer.frame, static_cast<std::uint64_t>(n));
    }
  }
  const auto received = meshes.wait_for(12);
  ASSERT_EQ(received.size(), 12u);
  for (std::size_t n = 0; n < 4; ++n) EXPECT_EQ(received[n]->vertices, received[n + 8]->vertices) << n;
  // The triangles are the same, but whoever goes by the version must not mistake one run's for another's.
  EXPECT_LT(received[3]->topology_version, received[4]->topology_version);
}

std::vector<std::string> lines_of(Collector<rosgraph_msgs::Log>& log, const std::string& words) {
  std::vector<std::string> lines;
  for (const auto& line : log.wait_for(0)) {
    if (line->msg.find(words) != std::string::npos) lines.push_back(line->msg);
  }
  return lines;
}

TEST_F(LiveInput, AClockThatGoesBackIsSaidOnce) {
  Collector<rosgraph_msgs::Log> log("/rosout");
  ASSERT_TRUE(log.wait_for_publisher());
  const auto node = load();
  for (const int n : {5, 6, 7, 0, 1, 2, 3}) EXPECT_LE(node->answer(n).state, State::TRACKED) << n;
  node->answer(changed(4, [](PointCloud2& cloud) { cloud.data.clear(); }));
  // What comes last in the log is there, and so is all before it.
  EXPECT_TRUE(wait_until([&] { return !lines_of(log, node->name() + ": cannot use the frame").empty(); }));
  EXPECT_EQ(lines_of(log, node->name() + ": the time went back, to stamp 1000.000000000").size(), 1u);
  EXPECT_EQ(lines_of(log, node->name() + ": the time went back").size(), 1u);
}

TEST_F(LiveInput, WhatMayComeWithEveryFrameIsSaidNowAndThenAndCounted) {
  Collector<rosgraph_msgs::Log> log("/rosout");
  ASSERT_TRUE(log.wait_for_publisher());
  const auto node = load();
  const auto bad = [](PointCloud2& cloud) { cloud.data.clear(); };
  node->answer(0);
  for (int n = 1; n < 5; ++n) node->send(changed(n, bad));
  ASSERT_EQ(node->statuses().wait_for(5).size(), 5u);
  const std::string words = node->name() + ": cannot use the frame";
  // Of another kind, which has its own five seconds.
  node->answer(0);
  node->answer(0);
  EXPECT_TRUE(wait_until([&] { return !lines_of(log, node->name() + ": skipped the frame").empty(); }));
  EXPECT_EQ(lines_of(log, words).size(), 1u);
  ros::WallDuration(5.1).sleep();
  node->answer(changed(5, bad));
  ASSERT_TRUE(wait_until([&] { return lines_of(log, words).size() == 2; }));
  EXPECT_NE(lines_of(log, words)[1].find("(and 3 more of this kind before)"), std::string::npos);
  EXPECT_EQ(lines_of(log, words)[0].find("more of this kind"), std::string::npos);
}

TEST_F(LiveInput, RepeatedAndLateFramesAreSkippedAndCounted) {
  const auto node = load();
  for (const int n : {0, 1, 3}) node->answer(n);
  const State repeated = node->answer(3);
  EXPECT_EQ(repeated.state, State::SKIPPED);
  EXPECT_NE(repeated.reason.find("stamp"), std::string::npos);
  const State late = node->answer(2);
  EXPECT_EQ(late.state, State::SKIPPED);
  EXPECT_EQ(late.frames_skipped, 2u);
  EXPECT_EQ(node->answer(4).state, State::TRACKED);
}

TEST_F(LiveInput, GapsAreCountedAndSaid) {
  Collector<rosgraph_msgs::Log> log("/rosout");
  const auto node = load();
  for (const int n : {0, 1, 2, 6}) node->answer(n);
  const State last = *node->statuses().wait_for(4).back();
  EXPECT_EQ(last.state, State::TRACKED);
  EXPECT_EQ(last.frames_missing, 3u);
  EXPECT_EQ(last.frame, 6u);
  ASSERT_EQ(last.warnings.size(), 1u);
  EXPECT_NE(last.warnings[0].find("3 frames are missing"), std::string::npos);
  EXPECT_TRUE(wait_until([&] {
    const auto lines = log.wait_for(0);
    return std::any_of(lines.begin(), lines.end(), [&](const auto& line) {
      return line->msg.find(node->name() + ": 3 frames are missing") == 0 &&
             line->msg.find("~queue_size") != std::string::npos;
    });
  }));
}

TEST_F(LiveInput, OtherFrameIdIsAReset) {
  const auto node = load();
  node->answer(0);
  const State other = node->answer(changed(0, [](PointCloud2& cloud) {
    cloud.header.frame_id = "basin";
    cloud.header.stamp.sec += 1;
  }));
  EXPECT_EQ(other.state, State::STARTED);
  EXPECT_EQ(other.run, 2u);
}

}  // namespace
}  // namespace particle_surface_tracker::test
