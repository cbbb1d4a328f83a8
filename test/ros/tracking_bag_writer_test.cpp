#include "particle_surface_tracker/ros/tracking_bag_writer.h"

#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <boost/make_shared.hpp>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/ros/mesh_conversion.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "ros_test_support.h"

namespace particle_surface_tracker::test {
namespace {

TriangleMesh small_mesh() {
  TriangleMesh mesh({Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, 0, 1)},
                    {Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{2, 0, 3}});
  mesh.delta() = {0.1f, 0.2f, 0.3f, 0.4f};
  return mesh;
}

sensor_msgs::PointCloud2ConstPtr cloud_of(int n) {
  return boost::make_shared<sensor_msgs::PointCloud2>(to_point_cloud(numbered_frame(n, 4), "tank"));
}

TEST(TrackingBagWriter, WritesMeshAndParticlesAtTheirStamp) {
  const TemporaryFolder folder;
  {
    TrackingBagWriter writer(folder / "out.bag", "/particles");
    for (int n = 0; n < 3; ++n) writer.write(cloud_of(n), to_tracked_mesh(cloud_of(n)->header, small_mesh(), 5));
    EXPECT_FALSE(std::filesystem::exists(folder / "out.bag"));
    writer.close();
    EXPECT_TRUE(std::filesystem::exists(folder / "out.bag"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out.bag.part"));
  }
  rosbag::Bag bag(folder / "out.bag");
  int clouds = 0;
  int meshes = 0;
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
    if (const auto cloud = message.instantiate<sensor_msgs::PointCloud2>()) {
      EXPECT_EQ(message.getTopic(), "/particles");
      EXPECT_TRUE(is_numbered_frame(*cloud, clouds++, 4));
      EXPECT_EQ(message.getTime(), cloud->header.stamp);
    }
    if (const auto mesh = message.instantiate<TrackedMesh>()) {
      EXPECT_EQ(message.getTopic(), "/tracked_mesh");
      EXPECT_EQ(message.getTime(), cloud_of(meshes)->header.stamp);
      EXPECT_EQ(mesh->header.stamp, cloud_of(meshes++)->header.stamp);
      EXPECT_EQ(mesh->header.frame_id, "tank");
      EXPECT_EQ(mesh->topology_version, 5u);
      EXPECT_EQ(mesh->vertices, (std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}));
      EXPECT_EQ(mesh->triangles, (std::vector<std::uint32_t>{0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}));
      EXPECT_EQ(mesh->delta, (std::vector<float>{0.1f, 0.2f, 0.3f, 0.4f}));
      EXPECT_EQ(mesh->ids, (std::vector<std::uint32_t>{0, 1, 2, 3}));
      EXPECT_TRUE(mesh->colors.empty());
    }
  }
  EXPECT_EQ(clouds, 3);
  EXPECT_EQ(meshes, 3);
}

TEST(TrackingBagWriter, StampZeroIsWritten) {
  const TemporaryFolder folder;
  TrackingBagWriter writer(folder / "out.bag", "/particles");
  sensor_msgs::PointCloud2 cloud = *cloud_of(0);
  cloud.header.stamp = ros::Time(0, 0);
  writer.write(boost::make_shared<sensor_msgs::PointCloud2>(cloud), to_tracked_mesh(cloud.header, small_mesh(), 1));
  writer.close();
  rosbag::Bag bag(folder / "out.bag");
  EXPECT_EQ(rosbag::View(bag).size(), 2u);
}

TEST(TrackingBagWriter, DestructionCompletesTheBag) {
  const TemporaryFolder folder;
  { TrackingBagWriter(folder / "out.bag", "/particles").write(cloud_of(0), to_tracked_mesh({}, small_mesh(), 1)); }
  EXPECT_NO_THROW(rosbag::Bag(folder / "out.bag"));
}

TEST(TrackingBagWriter, NothingIsLeftWithoutAFrame) {
  const TemporaryFolder folder;
  { TrackingBagWriter(folder / "out.bag", "/particles"); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(TrackingBagWriter, WhatCannotBeWrittenIsAnError) {
  const TemporaryFolder folder;
  EXPECT_THROW(TrackingBagWriter(folder / "missing/out.bag", "/particles"), OutputError);
  EXPECT_THROW(TrackingBagWriter(folder.path().string(), "/particles"), OutputError);
}

}  // namespace
}  // namespace particle_surface_tracker::test
