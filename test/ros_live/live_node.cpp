#include "ros_live/live_node.h"

#include <algorithm>
#include <utility>

#include <boost/make_shared.hpp>

#include "particle_surface_tracker/ros/particle_conversion.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test {

namespace {

sensor_msgs::PointCloud2Ptr to_message(ParticleFrame frame, int n) {
  frame.stamp_ns = 1000000000000 + n * std::int64_t{10000000};
  auto cloud = boost::make_shared<sensor_msgs::PointCloud2>(to_point_cloud(frame, "tank"));
  cloud->header.seq = static_cast<std::uint32_t>(n);
  return cloud;
}

}  // namespace

sensor_msgs::PointCloud2Ptr ball_cloud(int n) {
  static const ParticleFrame ball = fill_with_particles(Vec3d(-1, -1, -1), Vec3d(1, 1, 1), kBallSpacing, 0.0, 0,
                                                        [](const Vec3d& x) { return x.norm() < 0.95; });
  ParticleFrame frame = ball;
  for (Vec3f& position : frame.positions) position.x() += static_cast<float>(n * kBallSpacing / 16);
  return to_message(std::move(frame), n);
}

sensor_msgs::PointCloud2Ptr drops_cloud(int n) {
  static const ParticleFrame start = fill_with_particles(
      Vec3d(-1.4, -0.7, -0.7), Vec3d(1.4, 0.7, 0.7), kBallSpacing, 0.2, 3,
      [](const Vec3d& x) { return std::min((x - Vec3d(-0.8, 0, 0)).norm(), (x - Vec3d(0.8, 0.1, 0)).norm()) < 0.6; });
  ParticleFrame frame = start;
  for (Vec3f& x : frame.positions) x.x() += (x.x() < 0.0F ? 0.02F : -0.02F) * static_cast<float>(n);
  return to_message(std::move(frame), n);
}

TriangleMesh ball_mesh() {
  return make_sphere(Vec3d::Zero(), 1.0, 3);
}

LiveNode::LiveNode(nodelet::Loader& manager, std::string name, const std::string& mesh,
                   const std::map<std::string, std::string>& parameters)
    : manager_(manager), name_(std::move(name)), statuses_(name_ + "/status") {
  ros::param::del(name_);
  ros::param::set(name_ + "/mesh", mesh);
  ros::param::set(name_ + "/spacing", kBallSpacing);
  for (const auto& [key, value] : parameters) ros::param::set(name_ + "/" + key, value);
  const ros::M_string remappings = {{ros::names::resolve("particles"), input()},
                                    {ros::names::resolve("initial_mesh"), name_ + "/initial_mesh"}};
  loaded_ = manager_.load(name_, "particle_surface_tracker/TrackerNodelet", remappings, {});
  publisher_ = ros::NodeHandle().advertise<sensor_msgs::PointCloud2>(input(), 1000);
  if (!loaded_) return;
  wait_until([&] { return publisher_.getNumSubscribers() > 0; });
  statuses_.wait_for_publisher();
}

LiveNode::~LiveNode() {
  if (loaded_) manager_.unload(name_);
}

TrackerStatus LiveNode::answer(const sensor_msgs::PointCloud2ConstPtr& cloud) {
  const std::size_t before = statuses_.wait_for(0).size();
  send(cloud);
  const auto all = statuses_.wait_for(before + 1);
  if (all.size() <= before) throw std::runtime_error("the node does not answer");
  return *all[before];
}

}  // namespace particle_surface_tracker::test
