// Clouds that users build and read with PCL.

#include "particle_surface_tracker/ros/particle_point.h"

#include <gtest/gtest.h>
#include <pcl_conversions/pcl_conversions.h>

#include "particle_surface_tracker/ros/particle_conversion.h"
#include "ros/ros_test_support.h"

namespace particle_surface_tracker::test {
namespace {

TEST(ParticlePoint, CloudsOfPclAreRead) {
  pcl::PointCloud<ParticlePoint> particles;
  for (std::uint32_t n = 0; n < 5; ++n) {
    ParticlePoint point;
    point.x = 0.1f * static_cast<float>(n);
    point.y = -1.5f;
    point.z = 1e-7f;
    point.id = 0xfffffff0u + n;
    particles.push_back(point);
  }
  sensor_msgs::PointCloud2 cloud;
  pcl::toROSMsg(particles, cloud);
  cloud.header.stamp = ros::Time(7, 9);
  EXPECT_GT(cloud.point_step, 16u);  // With PCL's padding.
  const ParticleFrame frame = to_particle_frame(cloud);
  EXPECT_EQ(frame.stamp_ns, 7000000009);
  ASSERT_EQ(frame.size(), 5u);
  EXPECT_TRUE(frame.velocities.empty());
  for (std::uint32_t n = 0; n < 5; ++n) {
    EXPECT_EQ(frame.ids[n], 0xfffffff0u + n);
    EXPECT_EQ(frame.positions[n], Vec3f(0.1f * static_cast<float>(n), -1.5f, 1e-7f));
  }
}

TEST(ParticlePoint, CloudsWithVelocitiesOfPclAreRead) {
  pcl::PointCloud<MovingParticlePoint> particles;
  for (std::uint32_t n = 0; n < 3; ++n) {
    MovingParticlePoint point;
    point.x = point.y = point.z = static_cast<float>(n);
    point.id = 10 * n;
    point.vx = 1.0f + static_cast<float>(n);
    point.vy = -2.0f;
    point.vz = 0.25f;
    particles.push_back(point);
  }
  sensor_msgs::PointCloud2 cloud;
  pcl::toROSMsg(particles, cloud);
  const ParticleFrame frame = to_particle_frame(cloud);
  ASSERT_EQ(frame.velocities.size(), 3u);
  EXPECT_EQ(frame.velocities[2], Vec3f(3.0f, -2.0f, 0.25f));
  EXPECT_EQ(frame.ids[2], 20u);
}

TEST(ParticlePoint, PclReadsWhatTheLibraryWrites) {
  const ParticleFrame frame = numbered_frame(3, 6);
  const sensor_msgs::PointCloud2 cloud = to_point_cloud(frame, "tank");
  pcl::PointCloud<MovingParticlePoint> moving;
  pcl::fromROSMsg(cloud, moving);
  pcl::PointCloud<ParticlePoint> still;
  pcl::fromROSMsg(cloud, still);
  ASSERT_EQ(moving.size(), 6u);
  ASSERT_EQ(still.size(), 6u);
  for (std::size_t n = 0; n < 6; ++n) {
    EXPECT_EQ(Vec3f(moving[n].x, moving[n].y, moving[n].z), frame.positions[n]);
    EXPECT_EQ(Vec3f(still[n].x, still[n].y, still[n].z), frame.positions[n]);
    EXPECT_EQ(Vec3f(moving[n].vx, moving[n].vy, moving[n].vz), frame.velocities[n]);
    EXPECT_EQ(moving[n].id, frame.ids[n]);
    EXPECT_EQ(still[n].id, frame.ids[n]);
  }
}

}  // namespace
}  // namespace particle_surface_tracker::test
