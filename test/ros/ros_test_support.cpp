#include "ros_test_support.h"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

#include "particle_surface_tracker/ros/particle_conversion.h"

namespace particle_surface_tracker::test {

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot open " + path);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void write_file(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

ParticleFrame numbered_frame(int n, std::uint32_t count) {
  std::vector<Vec3f> positions;
  std::vector<Vec3f> velocities;
  std::vector<std::uint32_t> ids;
  for (std::uint32_t i = 0; i < count; ++i) {
    positions.emplace_back(static_cast<float>(n), static_cast<float>(i), 0.5f);
    velocities.emplace_back(static_cast<float>(i), static_cast<float>(n), -0.5f);
    ids.push_back(7 + 3 * i);
  }
  const std::int64_t stamp = 1000000000000 + n * std::int64_t{125000000};
  return make_particle_frame(stamp, std::move(positions), std::move(ids), std::move(velocities));
}

void write_numbered_bag(const std::string& path, int frames, std::uint32_t count, rosbag::CompressionType compression,
                        std::uint32_t chunk_size) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  bag.setCompression(compression);
  bag.setChunkThreshold(chunk_size);
  for (int n = 0; n < frames; ++n) {
    const sensor_msgs::PointCloud2 cloud = to_point_cloud(numbered_frame(n, count), "world");
    bag.write("/particles", cloud.header.stamp, cloud);
  }
  bag.close();
}

bool is_numbered_frame(const sensor_msgs::PointCloud2& cloud, int n, std::uint32_t count) {
  const ParticleFrame wanted = numbered_frame(n, count);
  const ParticleFrame found = to_particle_frame(cloud);
  return found.stamp_ns == wanted.stamp_ns && found.ids == wanted.ids && found.positions == wanted.positions &&
         found.velocities == wanted.velocities;
}

}  // namespace particle_surface_tracker::test
