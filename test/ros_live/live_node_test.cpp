// The nodelet in a real manager, in this process: what it answers, publishes and shares.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <thread>

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>
#include <gtest/gtest.h>
#include <rosgraph_msgs/Log.h>
#include <std_srvs/Trigger.h>
#include <visualization_msgs/Marker.h>
#include <boost/make_shared.hpp>

#include "particle_surface_tracker/io/mesh_writer.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "ros/ros_test_support.h"
#include "ros_live/live_node.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test {

nodelet::Loader* the_manager = nullptr;  // Of main().

namespace {

using Marker = visualization_msgs::Marker;
using sensor_msgs::PointCloud2;
using sensor_msgs::PointCloud2ConstPtr;
using sensor_msgs::PointCloud2Ptr;
using State = TrackerStatus;

class LiveNodeTest : public testing::Test {
 protected:
  LiveNodeTest() : mesh_(folder_ / "ball.ply") { write_ply(mesh_, ball_mesh()); }

  /// A node with a name of its own.
  std::unique_ptr<LiveNode> load(const std::map<std::string, std::string>& parameters = {}) {
    return std::make_unique<LiveNode>(manager(), next_name(), mesh_, parameters);
  }

  static std::string next_name() {
    static int count = 0;
    return "/tracker_" + std::to_string(++count);
  }

  static nodelet::Loader& manager() { return *the_manager; }

  /// Meshes as a FrameHandler makes them of the same clouds.
  FrameHandler handler() const {
    FrameHandlerOptions options;
    options.parameters.particle_spacing = kBallSpacing;
    options.mesh = ball_mesh();
    return FrameHandler(options);
  }

  TemporaryFolder folder_;
  std::string mesh_;
};

PointCloud2Ptr changed(int n, const std::function<void(PointCloud2&)>& change) {
  PointCloud2Ptr cloud = ball_cloud(n);
  change(*cloud);
  return cloud;
}

TEST_F(LiveNodeTest, MeshesHaveTheBytesOfTheFrameHandler) {
  const auto node = load({{"publish_normals", "true"}, {"publish_velocities", "true"}});
  ASSERT_TRUE(node->loaded());
  Collector<TrackedMesh> meshes(node->name() + "/mesh");
  ASSERT_TRUE(meshes.wait_for_publisher());
  for (int n = 0; n < 6; ++n) node->send(n);
  const auto received = meshes.wait_for(6);
  ASSERT_EQ(received.size(), 6u);
  FrameHandler offline = handler();
  for (int n = 0; n < 6; ++n) {
    offline.handle(*ball_cloud(n), static_cast<std::uint64_t>(n));
    EXPECT_EQ(bytes_of(*received[static_cast<std::size_t>(n)]), bytes_of(offline.message({true, true}))) << n;
  }
}

TEST_F(LiveNodeTest, MeshMessageHasEveryField) {
  const auto node = load({{"publish_normals", "true"}, {"publish_velocities", "true"}});
  Collector<TrackedMesh> meshes(node->name() + "/mesh");
  ASSERT_TRUE(meshes.wait_for_publisher());
  node->send(0);
  node->send(1);
  const auto received = meshes.wait_for(2);
  ASSERT_EQ(received.size(), 2u);
  const TriangleMesh ball = ball_mesh();
  const TrackedMesh& first = *received[0];
  const TrackedMesh& second = *received[1];
  EXPECT_EQ(first.header.stamp, ros::Time(1000, 0));
  EXPECT_EQ(first.header.frame_id, "tank");
  ASSERT_EQ(first.vertices.size(), 3 * ball.vertex_count());
  for (std::size_t v = 0; v < ball.vertex_count(); ++v) EXPECT_EQ(first.vertices[3 * v], ball.positions()[v].x());
  EXPECT_EQ(first.triangles.size(), 3 * ball.triangle_count());
  EXPECT_EQ(first.delta.size(), ball.vertex_count());
  EXPECT_EQ(first.ids.size(), ball.vertex_count());
  EXPECT_TRUE(first.colors.empty());
  EXPECT_TRUE(first.texcoords.empty());
  EXPECT_TRUE(first.velocities.empty());
  EXPECT_EQ(first.topology_version, second.topology_version);

  ASSERT_EQ(second.normals.size(), second.vertices.size());
  ASSERT_EQ(second.velocities.size(), second.vertices.size());
  const double speed = kBallSpacing / 16 / 0.01;
  for (std::size_t v = 0; v < ball.vertex_count(); ++v) {
    const Vec3f normal(&second.normals[3 * v]);
    EXPECT_NEAR(normal.norm(), 1.0f, 1e-5f);
    EXPECT_GT(normal.dot(ball.positions()[v]), 0.9f);
    EXPECT_NEAR(second.velocities[3 * v], speed, 0.05 * speed) << v;
    EXPECT_NEAR(second.velocities[3 * v + 1], 0.0, 0.05 * speed) << v;
  }
}

TEST_F(LiveNodeTest, StatusHasEveryField) {
  const auto node = load();
  const State first = node->answer(0);
  const State second = node->answer(1);
  EXPECT_EQ(first.state, State::STARTED);
  EXPECT_EQ(second.state, State::TRACKED);
  EXPECT_EQ(second.reason, "");
  EXPECT_EQ(second.header.stamp, ball_cloud(1)->header.stamp);
  EXPECT_EQ(second.header.frame_id, "tank");
  EXPECT_EQ(second.frame, 1u);
  EXPECT_EQ(second.run, 1u);
  EXPECT_EQ(second.frames_received, 2u);
  EXPECT_EQ(second.frames_tracked, 2u);
  EXPECT_EQ(second.frames_skipped + second.frames_dropped + second.frames_invalid + second.frames_failed, 0u);
  EXPECT_EQ(second.frames_missing, 0u);
  EXPECT_EQ(second.queue_length, 0u);
  EXPECT_GT(second.tracking_time, 0.0);
  EXPECT_GE(second.latency, second.tracking_time);
  EXPECT_EQ(second.particles, ball_cloud(1)->width);
  EXPECT_EQ(second.vertices, ball_mesh().vertex_count());
  EXPECT_EQ(second.triangles, ball_mesh().triangle_count());
  EXPECT_EQ(second.components, 1u);
  EXPECT_EQ(second.flagged_vertices, 0u);
  EXPECT_EQ(second.flagged_cells, 0u);
  EXPECT_EQ(second.original_vertices, ball_mesh().vertex_count());
  EXPECT_EQ(second.topology_version, 1u);
  EXPECT_NEAR(second.volume, 4.0 / 3.0 * M_PI, 0.1);
  // A ball of 5 r is narrow beside the kernel of 4 r: the isosurface lies well inside. What it encloses exactly is for
  // the handler to say.
  FrameHandler offline = handler();
  offline.handle(*ball_cloud(0), 0);
  const FrameReport report = offline.handle(*ball_cloud(1), 1);
  EXPECT_EQ(second.volume, report.volume);
  EXPECT_EQ(second.implicit_volume, report.implicit_volume);
  EXPECT_GT(second.implicit_volume, 0.0);
}

TEST_F(LiveNodeTest, MeshesAreShared) {
  const auto node = load();
  Collector<TrackedMesh> one(node->name() + "/mesh");
  Collector<TrackedMesh> other(node->name() + "/mesh");
  ASSERT_TRUE(one.wait_for_publisher());
  ASSERT_TRUE(other.wait_for_publisher());
  node->answer(0);
  node->answer(1);
  const auto at_one = one.wait_for(2);
  const auto at_other = other.wait_for(2);
  ASSERT_EQ(at_one.size(), 2u);
  ASSERT_EQ(at_other.size(), 2u);
  // Copies would have addresses of their own.
  for (int n = 0; n < 2; ++n) EXPECT_EQ(at_one[n].get(), at_other[n].get()) << n;
  EXPECT_NE(at_one[0].get(), at_one[1].get());
}

TEST_F(LiveNodeTest, ParticlesAreShared) {
  const auto node = load();
  // Who holds a cloud last deletes it. A copy would let this thread delete every one, as soon as it is sent.
  const std::thread::id here = std::this_thread::get_id();
  auto elsewhere = std::make_shared<std::atomic<int>>(0);
  for (int n = 0; n < 20; ++n) {
    const PointCloud2Ptr owner = ball_cloud(n);
    PointCloud2ConstPtr cloud(owner.get(), [owner, here, elsewhere](const PointCloud2*) {
      if (std::this_thread::get_id() != here) ++*elsewhere;
    });
    node->send(cloud);
  }
  ASSERT_EQ(node->statuses().wait_for(20).size(), 20u);
  EXPECT_GT(elsewhere->load(), 0);
}

TEST_F(LiveNodeTest, LateSubscribersGetTheLastMeshAndMarker) {
  const auto node = load();
  node->answer(0);
  node->answer(1);
  Collector<TrackedMesh> meshes(node->name() + "/mesh");
  Collector<Marker> markers(node->name() + "/marker");
  const auto late = meshes.wait_for(1);
  ASSERT_EQ(late.size(), 1u);
  EXPECT_EQ(late[0]->header.stamp, ball_cloud(1)->header.stamp);
  const auto marker = markers.wait_for(1);
  ASSERT_EQ(marker.size(), 1u);
  EXPECT_EQ(marker[0]->points.size(), late[0]->triangles.size());
}

TEST_F(LiveNodeTest, MarkerComesAtItsRateAndGoesWithTheReset) {
  const auto node = load({{"marker_max_rate", "2"}});
  Collector<Marker> markers(node->name() + "/marker");
  ASSERT_TRUE(markers.wait_for_publisher());
  const auto begin = std::chrono::steady_clock::now();
  for (int n = 0; n < 8; ++n) node->answer(n);
  // The first at once, the last when its time has come, though no more frames arrive.
  auto received = markers.wait_for(2);
  while (received.back()->header.stamp != ball_cloud(7)->header.stamp) {
    const auto more = markers.wait_for(received.size() + 1);
    ASSERT_GT(more.size(), received.size());
    received = more;
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  EXPECT_LE(static_cast<double>(received.size()), 2.0 + 2.0 * elapsed.count());
  EXPECT_LT(received.size(), 8u);
  for (const auto& marker : received) {
    EXPECT_EQ(marker->type, Marker::TRIANGLE_LIST);
    EXPECT_EQ(marker->action, Marker::ADD);
    EXPECT_EQ(marker->ns, received.front()->ns);
    EXPECT_EQ(marker->id, 0);
    EXPECT_EQ(marker->points.size(), 3 * ball_mesh().triangle_count());
  }
  std_srvs::Trigger reset;
  ASSERT_TRUE(ros::service::call(node->name() + "/reset", reset));
  EXPECT_TRUE(reset.response.success);
  EXPECT_FALSE(reset.response.message.empty());
  const std::size_t before = received.size();
  received = markers.wait_for(before + 1);
  ASSERT_GT(received.size(), before);
  EXPECT_EQ(received.back()->action, Marker::DELETE);
  EXPECT_EQ(received.back()->ns, received.front()->ns);
  EXPECT_EQ(received.back()->id, 0);
  EXPECT_EQ(node->answer(0).state, State::STARTED);
}

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

TEST_F(LiveNodeTest, BadCloudsAreAnsweredAndTheNextGoodOneIsTracked) {
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

TEST_F(LiveNodeTest, BadFirstCloudsDoNotStart) {
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

TEST_F(LiveNodeTest, EmptyCloudInTheMiddleIsTracked) {
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

TEST_F(LiveNodeTest, MeshAndParticlesThatDoNotBelongTogetherFail) {
  write_ply(mesh_, make_sphere(Vec3d(0, 0, 50), 1.0, 3));
  const auto node = load();
  const State answer = node->answer(0);
  EXPECT_EQ(answer.state, State::FAILED);
  EXPECT_NE(answer.reason.find("246 r"), std::string::npos) << answer.reason;
  EXPECT_EQ(answer.frames_failed, 1u);
}

TEST_F(LiveNodeTest, LoopedInputStartsAgainWithItsMesh) {
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

TEST_F(LiveNodeTest, RepeatedAndLateFramesAreSkippedAndCounted) {
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

TEST_F(LiveNodeTest, GapsAreCountedAndSaid) {
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

TEST_F(LiveNodeTest, OtherFrameIdIsAReset) {
  const auto node = load();
  node->answer(0);
  const State other = node->answer(changed(0, [](PointCloud2& cloud) {
    cloud.header.frame_id = "basin";
    cloud.header.stamp.sec += 1;
  }));
  EXPECT_EQ(other.state, State::STARTED);
  EXPECT_EQ(other.run, 2u);
}

TEST_F(LiveNodeTest, FullQueueDropsWhatArrivesAndAnswersAll) {
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

TEST_F(LiveNodeTest, PolicyLatestSkipsToTheNewest) {
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

class Reconfigure {
 public:
  explicit Reconfigure(const std::string& node) : node_(node), updates_(node + "/parameter_updates") {
    updates_.wait_for(1);
  }

  /// Asks for a value; returns the values in force after that.
  template <typename Value>
  dynamic_reconfigure::Config set(const std::string& name, const Value& value) {
    dynamic_reconfigure::Reconfigure call;
    dynamic_reconfigure::ConfigTools::appendParameter(call.request.config, name, value);
    if (!ros::service::call(node_ + "/set_parameters", call)) throw std::runtime_error("no reconfigure");
    return call.response.config;
  }

  Collector<dynamic_reconfigure::Config>& updates() { return updates_; }

 private:
  std::string node_;
  Collector<dynamic_reconfigure::Config> updates_;
};

template <typename Value>
Value value_of(const dynamic_reconfigure::Config& config, const std::string& name) {
  Value value{};
  if (!dynamic_reconfigure::ConfigTools::getParameter(config, name, value)) throw std::runtime_error("no " + name);
  return value;
}

TEST_F(LiveNodeTest, ParametersOfTheStartAreShownWithTheirRanges) {
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
    EXPECT_EQ(value_of<double>(description->max, info.name), info.maximum) << info.name;
  }
}

TEST_F(LiveNodeTest, ReconfiguredValuesAreAppliedBetweenFrames) {
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

TEST_F(LiveNodeTest, RefusedValuesAreSaidAndTheOldOnesShown) {
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

TEST_F(LiveNodeTest, ValuesThatNeedAResetWaitForIt) {
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

TEST_F(LiveNodeTest, NodesThatCannotStartSayWhyAndTheManagerLives) {
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

TEST_F(LiveNodeTest, UnknownParametersAreSaid) {
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

TEST_F(LiveNodeTest, TwoNodesInOneManagerDoNotDisturbEachOther) {
  const auto one = load();
  const auto other = load({{"advection", "average"}});
  Collector<TrackedMesh> of_one(one->name() + "/mesh");
  Collector<TrackedMesh> of_other(other->name() + "/mesh");
  ASSERT_TRUE(of_one.wait_for_publisher());
  ASSERT_TRUE(of_other.wait_for_publisher());
  for (int n = 0; n < 6; ++n) {
    one->send(n);
    other->send(n);
  }
  const auto meshes_of_one = of_one.wait_for(6);
  const auto meshes_of_other = of_other.wait_for(6);
  ASSERT_EQ(meshes_of_one.size(), 6u);
  ASSERT_EQ(meshes_of_other.size(), 6u);
  FrameHandler offline = handler();
  for (int n = 0; n < 6; ++n) offline.handle(*ball_cloud(n), static_cast<std::uint64_t>(n));
  EXPECT_EQ(meshes_of_one[5]->vertices, offline.message().vertices);
  EXPECT_NE(meshes_of_other[5]->vertices, offline.message().vertices);
}

}  // namespace
}  // namespace particle_surface_tracker::test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "live_node_test");
  ros::AsyncSpinner spinner(2);
  spinner.start();
  nodelet::Loader manager(/*provide_ros_api*/ false);
  particle_surface_tracker::test::the_manager = &manager;
  const int result = RUN_ALL_TESTS();
  particle_surface_tracker::test::the_manager = nullptr;
  return result;
}
