// main() of the tests of nodes in processes of their own.

#include <filesystem>

#include <gtest/gtest.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, std::filesystem::path(argv[0]).filename().string());
  ros::AsyncSpinner spinner(2);
  spinner.start();
  const ros::NodeHandle keeps_the_node_alive;
  return RUN_ALL_TESTS();
}
