#include "frame_reader.h"

#include <utility>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {

sensor_msgs::PointCloud2ConstPtr FrameReader::take(std::uint64_t frame) {
  const auto found = ahead_.find(frame);
  if (found == ahead_.end()) return bag_.read(frame);
  const Reading reading = std::move(found->second);
  ahead_.erase(found);
  return reading.get();
}

sensor_msgs::PointCloud2ConstPtr FrameReader::look_ahead(std::uint64_t frame) {
  if (ahead_.count(frame) == 0) prefetch(frame);
  try {
    return ahead_.at(frame).get();
  } catch (const InputError&) {
    return nullptr;
  }
}

void FrameReader::prefetch(std::uint64_t frame) {
  ahead_[frame] = std::async(std::launch::async, [this, frame] { return bag_.read(frame); }).share();
}

}  // namespace particle_surface_tracker
