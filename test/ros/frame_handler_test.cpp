#include "particle_surface_tracker/ros/frame_handler.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>
#include <boost/make_shared.hpp>

#include "frame_handler_cases.h"
#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test {
namespace {

double mean_x(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const Vec3f& position : mesh.positions()) sum += position.x();
  return sum / static_cast<double>(mesh.vertex_count());
}

TEST(FrameHandler, FirstCloudStartsAndOthersCarryTheMeshOn) {
  FrameHandler handler(ball_options());
  EXPECT_FALSE(handler.started());
  const FrameReport first = handler.handle(ball_cloud(0), 10);
  EXPECT_TRUE(handler.started());
  EXPECT_EQ(first.frame, 10u);
  EXPECT_EQ(first.stamp_ns, 1000000000);
  EXPECT_EQ(handler.tracker().mesh().positions(), ball_options().mesh->positions());
  const FrameReport second = handler.handle(ball_cloud(4), 11);
  EXPECT_EQ(second.frame, 11u);
  EXPECT_NEAR(mean_x(handler.tracker().mesh()), 4 * r / 8, 1e-3 * r);
}

TEST(FrameHandler, MessageHasTheHeaderOfTheCloudAndAVersionOfTheTriangles) {
  FrameHandler handler(ball_options());
  handler.handle(ball_cloud(0), 0);
  const TrackedMesh first = handler.message();
  handler.handle(ball_cloud(1), 1);
  const TrackedMesh second = handler.message();
  EXPECT_EQ(second.header.frame_id, "tank");
  EXPECT_EQ(second.header.stamp, ros::Time(1, 1));
  EXPECT_EQ(second.triangles, first.triangles);
  EXPECT_EQ(second.topology_version, first.topology_version);
  EXPECT_NE(second.vertices, first.vertices);
}

TEST(FrameHandler, BadCloudsChangeNothing) {
  FrameHandler handler(ball_options());
  FrameHandler undisturbed(ball_options());
  sensor_msgs::PointCloud2 truncated = ball_cloud(1);
  truncated.data.pop_back();
  sensor_msgs::PointCloud2 same_ids = ball_cloud(1);
  std::copy_n(&same_ids.data[12], 4, &same_ids.data[12 + same_ids.point_step]);

  EXPECT_THROW(handler.handle(truncated, 0), InputError);
  EXPECT_FALSE(handler.started());
  for (const int n : {0, 1, 2}) {
    handler.handle(ball_cloud(n), static_cast<std::uint64_t>(n));
    undisturbed.handle(ball_cloud(n), static_cast<std::uint64_t>(n));
    EXPECT_THROW(handler.handle(truncated, 5), InputError);
    EXPECT_THROW(handler.handle(same_ids, 5), ParticleError);
    EXPECT_EQ(handler.tracker().mesh().positions(), undisturbed.tracker().mesh().positions()) << n;
    EXPECT_EQ(handler.message().header.stamp, undisturbed.message().header.stamp) << n;
  }
}

TEST(FrameHandler, EmptyFirstCloudIsAnErrorAndTheNextOneStarts) {
  FrameHandler handler(ball_options());
  EXPECT_THROW(handler.handle(sensor_msgs::PointCloud2(), 0), ParticleError);
  EXPECT_FALSE(handler.started());
  handler.handle(ball_cloud(0), 1);
  EXPECT_TRUE(handler.started());
}

TEST(FrameHandler, WithoutAMeshTheImplicitSurfaceIsTracked) {
  FrameHandlerOptions options = ball_options();
  options.mesh.reset();
  FrameHandler handler(options);
  const FrameReport report = handler.handle(ball_cloud(0), 0);
  EXPECT_EQ(report.components, 1u);
  EXPECT_NEAR(report.volume, report.implicit_volume, 1e-6 * report.volume);
  EXPECT_EQ(handler.tracker().mesh().vertex_count(),
            handler.tracker().implicit_surface()->triangulation.vertices.size());
}

TEST(FrameHandler, RefinedMeshHasNoEdgeLongerThanTheSpacing) {
  FrameHandlerOptions options = ball_options();
  options.mesh = make_sphere(Vec3d::Zero(), 1.0, 2);
  options.refine_mesh = true;
  FrameHandler handler(options);
  handler.handle(ball_cloud(0), 0);
  const TriangleMesh& mesh = handler.tracker().mesh();
  EXPECT_GT(mesh.vertex_count(), options.mesh->vertex_count());
  for (std::size_t v = 0; v < options.mesh->vertex_count(); ++v) {
    EXPECT_EQ(mesh.positions()[v], options.mesh->positions()[v]) << v;
  }
  for (const Triangle& t : mesh.triangles()) {
    for (int corner = 0; corner < 3; ++corner) {
      EXPECT_LE((mesh.positions()[t[corner]] - mesh.positions()[t[(corner + 1) % 3]]).norm(), r * 1.00001);
    }
  }
}

TEST(FrameHandler, ResetStartsAgainWithTheInitialMesh) {
  FrameHandler handler(ball_options());
  handler.handle(ball_cloud(0), 0);
  const TrackedMesh first = handler.message({true, true});
  handler.handle(ball_cloud(1), 1);
  EXPECT_EQ(handler.message({false, true}).velocities.size(), first.vertices.size());
  handler.reset();
  EXPECT_FALSE(handler.started());
  handler.handle(ball_cloud(0), 0);
  const TrackedMesh again = handler.message({true, true});
  EXPECT_EQ(again.vertices, first.vertices);
  EXPECT_EQ(again.normals, first.normals);
  EXPECT_TRUE(again.velocities.empty());
  EXPECT_GT(again.topology_version, first.topology_version);
}

TEST(FrameHandler, FramesOfOneStampHaveNoVelocities) {
  FrameHandler handler(ball_options());
  sensor_msgs::PointCloud2 cloud = ball_cloud(0);
  handler.handle(cloud, 0);
  handler.handle(cloud, 1);
  EXPECT_TRUE(handler.message({false, true}).velocities.empty());
}

TEST(FrameHandler, LookingAheadChangesNothing) {
  FrameHandler ahead(ball_options());
  FrameHandler handler(ball_options());
  std::vector<sensor_msgs::PointCloud2ConstPtr> clouds;
  for (int n = 0; n < 6; ++n) clouds.push_back(boost::make_shared<sensor_msgs::PointCloud2>(ball_cloud(n)));
  const auto broken = boost::make_shared<sensor_msgs::PointCloud2>(ball_cloud(2));
  broken->data.pop_back();
  clouds[2] = broken;
  clouds[4] =
      boost::make_shared<sensor_msgs::PointCloud2>(to_point_cloud(make_particle_frame(2000000000, {}, {}), "tank"));
  for (std::size_t n = 0; n < clouds.size(); ++n) {
    if (n + 1 < clouds.size()) ahead.look_ahead(clouds[n + 1]);
    if (n == 2) {
      EXPECT_THROW(ahead.handle(*clouds[n], n), InputError);
      continue;
    }
    const FrameReport report = ahead.handle(*clouds[n], n);
    EXPECT_EQ(report.volume, handler.handle(*clouds[n], n).volume);
    expect_same_messages(ahead, handler);
  }
  // What was looked at is not always what comes.
  ahead.look_ahead(clouds[0]);
  ahead.handle(*clouds[1], 6);
  handler.handle(*clouds[1], 6);
  ahead.look_ahead(clouds[3]);
  ahead.reset();
  handler.reset();
  ahead.handle(*clouds[0], 0);
  handler.handle(*clouds[0], 0);
  expect_same_messages(ahead, handler);
}

}  // namespace
}  // namespace particle_surface_tracker::test
