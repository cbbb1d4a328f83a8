// What the live node adds to the time of tracking: particles and mesh in one nodelet manager, all in this process. Also
// the ways from a message to a particle frame. Needs a master: live_benchmark.launch.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <vector>

#include <nodelet/loader.h>
#include <particle_surface_tracker/TrackedMesh.h>
#include <particle_surface_tracker/TrackerStatus.h>
#include <pcl_conversions/pcl_conversions.h>
#include <ros/ros.h>
#include <visualization_msgs/Marker.h>
#include <boost/make_shared.hpp>

#include "arrivals.h"
#include "particle_surface_tracker/io/mesh_writer.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "particle_surface_tracker/ros/particle_point.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kSpacing = 0.0469;
constexpr int kFrames = 40;

// A torus of about 28,000 particles and 60,000 triangles.
ParticleFrame torus_particles() {
  return test::fill_with_particles(Vec3d(-1.5, -1.5, -0.5), Vec3d(1.5, 1.5, 0.5), kSpacing, 0.0, 0, [](const Vec3d& x) {
    const double ring = std::hypot(x.x(), x.y()) - 1.0;
    return std::hypot(ring, x.z()) < 0.4 - 0.4 * kSpacing;
  });
}

sensor_msgs::PointCloud2Ptr cloud_of(const ParticleFrame& particles, int n) {
  ParticleFrame frame = particles;
  for (Vec3f& position : frame.positions) position.x() += static_cast<float>(0.1 * kSpacing * n);
  frame.stamp_ns = 1000000000000 + n * std::int64_t{10000000};
  return boost::make_shared<sensor_msgs::PointCloud2>(to_point_cloud(frame, "world"));
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void measure_transport(const ParticleFrame& particles) {
  const std::string mesh = "/tmp/particle_surface_tracker_live_benchmark.ply";
  write_ply(mesh, test::make_torus(Vec3d::Zero(), 1.0, 0.4, 300, 100));
  ros::param::set("/tracker/mesh", mesh);
  ros::param::set("/tracker/spacing", kSpacing);
  nodelet::Loader manager(/*provide_ros_api*/ false);
  if (!manager.load("/tracker", "particle_surface_tracker/TrackerNodelet", {}, {})) {
    throw std::runtime_error("the nodelet cannot be loaded");
  }
  {
    Arrivals<TrackedMesh> meshes("/tracker/mesh");
    Arrivals<TrackerStatus> statuses("/tracker/status");
    ros::Publisher publisher = ros::NodeHandle().advertise<sensor_msgs::PointCloud2>("particles", 10);
    while (publisher.getNumSubscribers() == 0) ros::WallDuration(0.01).sleep();
    std::vector<double> added;
    std::vector<double> tracking;
    for (int n = 0; n < kFrames; ++n) {
      const sensor_msgs::PointCloud2Ptr cloud = cloud_of(particles, n);
      const auto begin = Clock::now();
      publisher.publish(cloud);
      const std::chrono::duration<double> elapsed = meshes.wait_for(n + 1) - begin;
      statuses.wait_for(n + 1);
      added.push_back(elapsed.count() - statuses.last()->tracking_time);
      tracking.push_back(statuses.last()->tracking_time);
    }
    std::printf(
        "%zu particles, %zu triangles, one manager: tracking %.1f ms, the way in and out adds %.2f ms "
        "(median; least %.2f, greatest %.2f)\n",
        particles.size(), meshes.last()->triangles.size() / 3, 1e3 * median(tracking), 1e3 * median(added),
        1e3 * *std::min_element(added.begin(), added.end()), 1e3 * *std::max_element(added.begin(), added.end()));
  }
  manager.unload("/tracker");
}

double thread_milliseconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

template <typename Convert>
void measure_conversion(const char* name, const Convert& convert) {
  std::vector<double> times;
  std::size_t size = 0;
  for (int n = 0; n < 200; ++n) {
    const double begin = thread_milliseconds();
    size += convert().size();
    times.push_back(thread_milliseconds() - begin);
  }
  std::printf("%s: %.3f ms of processor time (%zu particles)\n", name, median(times), size / 200);
}

ParticleFrame by_pcl(const sensor_msgs::PointCloud2& cloud) {
  check_particle_cloud(cloud);
  pcl::PointCloud<ParticlePoint> points;
  pcl::fromROSMsg(cloud, points);
  std::vector<Vec3f> positions;
  std::vector<std::uint32_t> ids;
  positions.reserve(points.size());
  ids.reserve(points.size());
  for (const ParticlePoint& point : points) {
    positions.emplace_back(point.x, point.y, point.z);
    ids.push_back(point.id);
  }
  return make_particle_frame(0, std::move(positions), std::move(ids));
}

}  // namespace
}  // namespace particle_surface_tracker

int main(int argc, char** argv) {
  using namespace particle_surface_tracker;
  ros::init(argc, argv, "live_benchmark");
  ros::AsyncSpinner spinner(2);
  spinner.start();
  const ros::NodeHandle keeps_the_node_alive;
  const ParticleFrame particles = torus_particles();
  measure_transport(particles);
  const sensor_msgs::PointCloud2Ptr cloud = cloud_of(particles, 0);
  measure_conversion("message to particle frame, directly", [&] { return to_particle_frame(*cloud); });
  measure_conversion("message to particle frame, through pcl::fromROSMsg", [&] { return by_pcl(*cloud); });
  return 0;
}
