// What the live node publishes: every field, shared and not copied.

#include <atomic>
#include <cmath>
#include <memory>
#include <thread>

#include <gtest/gtest.h>
#include <visualization_msgs/Marker.h>

#include "ros_live/live_node_test.h"

namespace particle_surface_tracker::test {
namespace {

using sensor_msgs::PointCloud2;
using sensor_msgs::PointCloud2ConstPtr;
using sensor_msgs::PointCloud2Ptr;
using visualization_msgs::Marker;
using State = TrackerStatus;

class LiveFields : public LiveNodeTest {};

TEST_F(LiveFields, MeshesHaveTheBytesOfTheFrameHandler) {
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

TEST_F(LiveFields, MeshMessageHasEveryField) {
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

TEST_F(LiveFields, StatusHasEveryField) {
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

TEST_F(LiveFields, MeshesAreShared) {
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

TEST_F(LiveFields, ParticlesAreShared) {
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

TEST_F(LiveFields, LateSubscribersGetTheLastMeshAndMarker) {
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

TEST_F(LiveFields, TwoNodesInOneManagerDoNotDisturbEachOther) {
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
