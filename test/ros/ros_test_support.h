#pragma once

#include <cstdint>
#include <string>

#include <rosbag/bag.h>
#include <sensor_msgs/PointCloud2.h>

#include "particle_surface_tracker/core/particle_frame.h"
#include "support/temporary_folder.h"

namespace particle_surface_tracker::test {

std::string read_file(const std::string& path);
void write_file(const std::string& path, const std::string& bytes);

/// The particles of frame n of a little sequence: `count` of them, with coordinates and velocities that tell n and the
/// id.
ParticleFrame numbered_frame(int n, std::uint32_t count);

/// Writes numbered frames 0 … frames − 1 to /particles, one every 1/8 s from 1000 s on.
/// \param chunk_size bytes after which a new chunk begins; 1 makes one of every frame.
void write_numbered_bag(const std::string& path, int frames, std::uint32_t count,
                        rosbag::CompressionType compression = rosbag::compression::Uncompressed,
                        std::uint32_t chunk_size = 1);

/// Whether a cloud is that of numbered_frame(n, count).
bool is_numbered_frame(const sensor_msgs::PointCloud2& cloud, int n, std::uint32_t count);

/// The text of the Exception that a call throws; a failure if it does not.
template <typename Exception, typename Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const Exception& error) {
    return error.what();
  }
  return "no error was thrown";
}

}  // namespace particle_surface_tracker::test
