#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <sensor_msgs/PointCloud2.h>

namespace particle_surface_tracker {

/// The particle clouds of one topic of a bag, in the order in which they were recorded.
///
/// Reads bags that were damaged or never closed as far as they can be read, and says what is missing. Nothing in the
/// file is believed unchecked: rosbag's own reader opens no bag without an index, and a flipped bit in a bag without
/// compression makes it read outside its memory.
class ParticleBag {
 public:
  /// \throw InputError if the file is not a bag of format 2.0, has no such topic (the topics it has are listed), or the
  /// topic's messages are of another type.
  ParticleBag(const std::string& path, const std::string& topic);
  ~ParticleBag();

  /// Number of messages of the topic; the index of a frame is its place among them.
  std::size_t size() const;

  /// \param frame < size().
  /// \throw InputError if this message cannot be read; others still may.
  sensor_msgs::PointCloud2ConstPtr read(std::size_t frame);

  /// What is damaged in the bag, in words; empty when all is well.
  const std::vector<std::string>& damage() const;

 private:
  struct Contents;
  std::unique_ptr<Contents> contents_;
};

}  // namespace particle_surface_tracker
