#include "particle_surface_tracker/ros/particle_bag.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "ros_test_support.h"

namespace particle_surface_tracker::test {
namespace {

class ParticleBagOf : public testing::TestWithParam<rosbag::CompressionType> {};

TEST_P(ParticleBagOf, EveryCompressionAndChunkSizeReadsAllFrames) {
  const TemporaryFolder folder;
  for (const std::uint32_t chunk_size : {1u, 5000u, 1000000u}) {
    const std::string path = folder / fmt::format("chunks_of_{}.bag", chunk_size);
    write_numbered_bag(path, 12, 50, GetParam(), chunk_size);
    ParticleBag bag(path, "/particles");
    EXPECT_TRUE(bag.damage().empty());
    ASSERT_EQ(bag.size(), 12u);
    for (const int n : {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 3, 0}) {
      EXPECT_TRUE(is_numbered_frame(*bag.read(static_cast<std::size_t>(n)), n, 50)) << n;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Compressions, ParticleBagOf,
                         testing::Values(rosbag::compression::Uncompressed, rosbag::compression::BZ2,
                                         rosbag::compression::LZ4));

TEST(ParticleBag, OrderIsThatOfRosbag) {
  // Messages written out of order, beside another topic, over two connections of the topic.
  const TemporaryFolder folder;
  const std::string path = folder / "mixed.bag";
  {
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    bag.setChunkThreshold(3000);
    const auto other_publisher = boost::make_shared<ros::M_string>();
    (*other_publisher)["callerid"] = "/second";
    (*other_publisher)["type"] = "sensor_msgs/PointCloud2";
    (*other_publisher)["md5sum"] = ros::message_traits::md5sum<sensor_msgs::PointCloud2>();
    (*other_publisher)["message_definition"] = ros::message_traits::definition<sensor_msgs::PointCloud2>();
    int written = 0;
    for (const int n : {4, 0, 7, 2, 2, 9, 1, 5, 3, 8, 6}) {
      std_msgs::String text;
      text.data = "between";
      bag.write("/chatter", ros::Time(1001, 0), text);
      const sensor_msgs::PointCloud2 cloud = to_point_cloud(numbered_frame(n, 20), "world");
      bag.write("/particles", cloud.header.stamp, cloud, ++written % 3 == 0 ? other_publisher : nullptr);
    }
    bag.close();
  }
  ParticleBag ours(path, "/particles");
  rosbag::Bag bag(path);
  rosbag::View view(bag, rosbag::TopicQuery("/particles"));
  ASSERT_EQ(ours.size(), view.size());
  std::size_t frame = 0;
  for (const rosbag::MessageInstance& message : view) {
    const auto cloud = message.instantiate<sensor_msgs::PointCloud2>();
    EXPECT_EQ(cloud->header.stamp, ours.read(frame)->header.stamp) << frame;
    EXPECT_EQ(cloud->data, ours.read(frame)->data) << frame;
    ++frame;
  }
}

TEST(ParticleBag, AbsentTopicListsWhatIsThere) {
  const TemporaryFolder folder;
  write_numbered_bag(folder / "a.bag", 2, 3);
  const std::string text = error_of<InputError>([&folder] { ParticleBag(folder / "a.bag", "/nothing"); });
  EXPECT_NE(text.find("/nothing"), std::string::npos) << text;
  EXPECT_NE(text.find("/particles (sensor_msgs/PointCloud2)"), std::string::npos) << text;
}

TEST(ParticleBag, OtherMessageTypeIsNamed) {
  const TemporaryFolder folder;
  {
    rosbag::Bag bag(folder / "text.bag", rosbag::bagmode::Write);
    bag.write("/particles", ros::Time(1, 0), std_msgs::String());
    bag.close();
  }
  const std::string text = error_of<InputError>([&folder] { ParticleBag(folder / "text.bag", "/particles"); });
  for (const char* word : {"/particles", "std_msgs/String", "sensor_msgs/PointCloud2"}) {
    EXPECT_NE(text.find(word), std::string::npos) << text;
  }
}

TEST(ParticleBag, BagWithoutMessagesIsAnError) {
  const TemporaryFolder folder;
  write_numbered_bag(folder / "empty.bag", 0, 0);
  const std::string text = error_of<InputError>([&folder] { ParticleBag(folder / "empty.bag", "/particles"); });
  EXPECT_NE(text.find("it has: none"), std::string::npos) << text;
}

TEST(ParticleBag, WhatIsNoBagIsAnError) {
  const TemporaryFolder folder;
  write_file(folder / "zero", "");
  write_file(folder / "text", "This is no bag at all, but it is longer than the magic line.");
  write_file(folder / "short", "#ROS");
  write_file(folder / "old", "#ROSBAG V1.2\nand so on");
  const auto text_of = [&folder](const char* name) {
    return error_of<InputError>([&folder, name] { ParticleBag(folder / name, "/particles"); });
  };
  EXPECT_NE(text_of("missing").find("No such file"), std::string::npos) << text_of("missing");
  EXPECT_NE(text_of("zero").find("empty"), std::string::npos) << text_of("zero");
  EXPECT_NE(text_of(".").find("no file"), std::string::npos) << text_of(".");
  EXPECT_NE(text_of("text").find("not a bag"), std::string::npos) << text_of("text");
  EXPECT_NE(text_of("short").find("not a bag"), std::string::npos) << text_of("short");
  EXPECT_NE(text_of("old").find("old format"), std::string::npos) << text_of("old");
}

}  // namespace
}  // namespace particle_surface_tracker::test
