// Services of the live node, and its initial mesh from a topic.

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <particle_surface_tracker/SaveMesh.h>
#include <rosgraph_msgs/Log.h>
#include <shape_msgs/Mesh.h>
#include <std_srvs/SetBool.h>

#include "particle_surface_tracker/io/mesh_reader.h"
#include "particle_surface_tracker/ros/mesh_conversion.h"
#include "ros_live/live_node_test.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test {
namespace {

using State = TrackerStatus;

class LiveServices : public LiveNodeTest {};

SaveMesh::Response save(const LiveNode& node, const std::string& path) {
  SaveMesh call;
  call.request.path = path;
  EXPECT_TRUE(ros::service::call(node.name() + "/save_mesh", call));
  return call.response;
}

void pause(const LiveNode& node, bool paused) {
  std_srvs::SetBool call;
  call.request.data = paused;
  ASSERT_TRUE(ros::service::call(node.name() + "/pause", call));
  EXPECT_TRUE(call.response.success);
  EXPECT_FALSE(call.response.message.empty());
}

std::size_t warnings_of(Collector<rosgraph_msgs::Log>& log, const std::string& words) {
  const auto lines = log.wait_for(0);
  return static_cast<std::size_t>(std::count_if(lines.begin(), lines.end(), [&](const auto& line) {
    return line->level == rosgraph_msgs::Log::WARN && line->msg.find(words) == 0;
  }));
}

// The last status, once there is one that fulfils a condition.
template <typename Condition>
State wait_for_status(LiveNode& node, Condition&& condition) {
  State last;
  EXPECT_TRUE(wait_until([&] {
    const auto all = node.statuses().wait_for(0);
    if (!all.empty()) last = *all.back();
    return !all.empty() && condition(last);
  }));
  return last;
}

TEST_F(LiveServices, TheLastMeshIsSaved) {
  const auto node = load({{"save_folder", folder_.path().string()}});
  Collector<TrackedMesh> meshes(node->name() + "/mesh");
  ASSERT_TRUE(meshes.wait_for_publisher());
  const SaveMesh::Response early = save(*node, "early.ply");
  EXPECT_FALSE(early.success);
  EXPECT_NE(early.message.find("nothing is tracked"), std::string::npos) << early.message;
  node->answer(0);
  node->answer(1);
  ASSERT_EQ(meshes.wait_for(2).size(), 2u);
  const SaveMesh::Response answer = save(*node, "meshes/one.ply");
  ASSERT_TRUE(answer.success) << answer.message;
  EXPECT_EQ(std::filesystem::path(answer.path), std::filesystem::canonical(folder_.path()) / "meshes/one.ply");
  EXPECT_EQ(read_initial_mesh(answer.path).mesh.positions(), to_triangle_mesh(*meshes.wait_for(2)[1]).positions());
  EXPECT_TRUE(save(*node, "meshes/one.obj").success);
  // Nothing temporary is left.
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path() / "meshes"), {}), 2);
}

TEST_F(LiveServices, NothingIsSavedOutsideOfTheFolder) {
  const auto node = load({{"save_folder", folder_.path().string()}});
  node->answer(0);
  for (const std::string path : {"../out.ply", "/tmp/out.ply", "", ".", "a/../../out.ply", "mesh.exe"}) {
    const SaveMesh::Response answer = save(*node, path);
    EXPECT_FALSE(answer.success) << path;
    EXPECT_FALSE(answer.message.empty()) << path;
    EXPECT_EQ(answer.path, "") << path;
  }
  EXPECT_EQ(folder_.entry_count(), 1u);  // The mesh to begin with.
  const auto without = load();
  without->answer(0);
  const SaveMesh::Response answer = save(*without, "mesh.ply");
  EXPECT_FALSE(answer.success);
  EXPECT_NE(answer.message.find("~save_folder"), std::string::npos) << answer.message;
}

TEST_F(LiveServices, FramesWaitDuringAPause) {
  const auto node = load();
  node->answer(0);
  pause(*node, true);
  wait_for_status(*node, [](const State& status) { return status.state == State::WAITING; });
  for (int n = 1; n < 4; ++n) node->send(n);
  const State waiting = wait_for_status(*node, [](const State& status) { return status.queue_length == 3; });
  EXPECT_EQ(waiting.state, State::WAITING);
  EXPECT_NE(waiting.reason.find("paused"), std::string::npos) << waiting.reason;
  EXPECT_EQ(waiting.frames_received, 1u);
  // A player that is paced by it must not take the frames for done.
  EXPECT_EQ(waiting.header.stamp, ball_cloud(0)->header.stamp);
  pause(*node, false);
  const State last = wait_for_status(*node, [](const State& status) { return status.frames_received == 4; });
  EXPECT_EQ(last.state, State::TRACKED);
  EXPECT_EQ(last.frames_tracked, 4u);
  EXPECT_EQ(last.frame, 3u);
}

TEST_F(LiveServices, WhatIsDroppedDuringAPauseIsSaidAtOnce) {
  Collector<rosgraph_msgs::Log> log("/rosout");
  const auto node = load({{"queue_size", "2"}});
  node->answer(0);
  pause(*node, true);
  wait_for_status(*node, [](const State& status) { return status.state == State::WAITING; });
  for (int n = 1; n < 8; ++n) node->send(n);
  const State waiting = wait_for_status(
      *node, [](const State& status) { return status.state == State::WAITING && status.frames_dropped == 5; });
  EXPECT_EQ(waiting.queue_length, 2u);
  EXPECT_EQ(waiting.frames_received, 6u);
  EXPECT_EQ(waiting.header.stamp, ball_cloud(0)->header.stamp);
  EXPECT_TRUE(wait_until([&] { return warnings_of(log, node->name() + ": dropped the frame of stamp") > 0; }));
  pause(*node, false);
  wait_for_status(*node, [](const State& status) { return status.frames_received == 8; });
  // Those that waited come before those that were dropped, and are counted so.
  const State next = node->answer(8);
  EXPECT_EQ(next.state, State::TRACKED);
  EXPECT_EQ(next.frames_tracked, 4u);
  EXPECT_EQ(next.frames_dropped, 5u);
  EXPECT_EQ(next.frames_missing, 0u);
  EXPECT_EQ(next.frame, 8u);
}

TEST_F(LiveServices, StrictTracksWhatWaitedBeforeAGapInAPause) {
  const auto node = load({{"queue_policy", "strict"}, {"queue_size", "2"}});
  node->answer(0);
  pause(*node, true);
  wait_for_status(*node, [](const State& status) { return status.state == State::WAITING; });
  for (int n = 1; n < 5; ++n) node->send(n);
  wait_for_status(*node, [](const State& status) { return status.frames_failed == 2; });
  // What waits belongs to the run that the reset begins; so does the gap behind it.
  call_reset(*node);
  pause(*node, false);
  const State waited = wait_for_status(*node, [](const State& status) { return status.frames_received == 5; });
  EXPECT_EQ(waited.state, State::TRACKED);
  EXPECT_EQ(waited.run, 2u);
  const State next = node->answer(5);
  EXPECT_EQ(next.state, State::FAILED);
  EXPECT_NE(next.reason.find("queue_size is 2"), std::string::npos) << next.reason;
  call_reset(*node);
  EXPECT_EQ(node->answer(6).state, State::STARTED);
  EXPECT_EQ(node->answer(7).state, State::TRACKED);
}

TEST_F(LiveServices, PolicyLatestSkipsDuringAPause) {
  const auto node = load({{"queue_policy", "latest"}});
  node->answer(0);
  pause(*node, true);
  wait_for_status(*node, [](const State& status) { return status.state == State::WAITING; });
  for (int n = 1; n < 6; ++n) node->send(n);
  // All but the newest are answered at once.
  const State waiting = wait_for_status(*node, [](const State& status) { return status.frames_received == 5; });
  EXPECT_EQ(waiting.frames_skipped, 4u);
  EXPECT_EQ(waiting.queue_length, 1u);
  pause(*node, false);
  const State last = wait_for_status(*node, [](const State& status) { return status.frames_received == 6; });
  EXPECT_EQ(last.state, State::TRACKED);
  EXPECT_EQ(last.frame, 5u);
}

TEST_F(LiveServices, AResetDuringAPauseIsDone) {
  const auto node = load();
  node->answer(0);
  pause(*node, true);
  call_reset(*node);
  pause(*node, false);
  const State next = wait_for_status(*node, [](const State& status) { return status.state == State::WAITING; });
  EXPECT_EQ(next.run, 1u);
  node->send(1);
  const State begun = wait_for_status(*node, [](const State& status) { return status.frames_received == 2; });
  EXPECT_EQ(begun.state, State::STARTED);
  EXPECT_EQ(begun.run, 2u);
}

shape_msgs::Mesh as_shape(const TriangleMesh& mesh) {
  shape_msgs::Mesh message;
  for (const Vec3f& position : mesh.positions()) {
    geometry_msgs::Point point;
    point.x = position.x();
    point.y = position.y();
    point.z = position.z();
    message.vertices.push_back(point);
  }
  for (const Triangle& triangle : mesh.triangles()) {
    shape_msgs::MeshTriangle corners;
    std::copy(triangle.begin(), triangle.end(), corners.vertex_indices.begin());
    message.triangles.push_back(corners);
  }
  return message;
}

TEST_F(LiveServices, TheRunStartsWhenMeshAndParticlesAreThere) {
  const auto node = load({{"mesh", "topic"}});
  Collector<TrackedMesh> meshes(node->name() + "/mesh");
  ASSERT_TRUE(meshes.wait_for_publisher());
  for (int n = 0; n < 3; ++n) node->send(n);
  const State waiting = wait_for_status(*node, [](const State& status) { return status.queue_length == 3; });
  EXPECT_EQ(waiting.state, State::WAITING);
  EXPECT_NE(waiting.reason.find("initial_mesh"), std::string::npos) << waiting.reason;
  ros::Publisher publisher =
      ros::NodeHandle().advertise<shape_msgs::Mesh>(node->name() + "/initial_mesh", 1, /*latch*/ true);
  publisher.publish(as_shape(ball_mesh()));
  ASSERT_EQ(meshes.wait_for(3).size(), 3u);
  FrameHandler offline = handler();
  for (int n = 0; n < 3; ++n) {
    offline.handle(*ball_cloud(n), static_cast<std::uint64_t>(n));
    EXPECT_EQ(bytes_of(*meshes.wait_for(3)[static_cast<std::size_t>(n)]), bytes_of(offline.message())) << n;
  }
}

TEST_F(LiveServices, MeshesThatCannotBeTrackedAreSaidAndTheNextOneIsTaken) {
  const auto node = load({{"mesh", "topic"}});
  ros::Publisher publisher = ros::NodeHandle().advertise<TrackedMesh>(node->name() + "/initial_mesh", 5);
  ASSERT_TRUE(wait_until([&] { return publisher.getNumSubscribers() > 0; }));
  TrackedMesh mesh = to_tracked_mesh({}, ball_mesh(), 1);
  TrackedMesh open = mesh;
  open.triangles.resize(open.triangles.size() - 3);
  publisher.publish(open);
  TrackedMesh damaged = mesh;
  damaged.vertices.pop_back();
  publisher.publish(damaged);
  node->send(0);
  const State waiting = wait_for_status(*node, [](const State& status) { return status.queue_length == 1; });
  EXPECT_EQ(waiting.state, State::WAITING);
  // Only vertices and triangles are asked for.
  mesh.ids.clear();
  mesh.delta.clear();
  publisher.publish(mesh);
  const State begun = wait_for_status(*node, [](const State& status) { return status.frames_received == 1; });
  EXPECT_EQ(begun.state, State::STARTED);
  EXPECT_EQ(begun.vertices, ball_mesh().vertex_count());
  // Another one is used after the reset.
  const TriangleMesh finer = make_sphere(Vec3d::Zero(), 1.0, 4);
  publisher.publish(to_tracked_mesh({}, finer, 1));
  EXPECT_EQ(node->answer(1).vertices, ball_mesh().vertex_count());
  call_reset(*node);
  EXPECT_EQ(node->answer(0).vertices, finer.vertex_count());
}

}  // namespace
}  // namespace particle_surface_tracker::test
