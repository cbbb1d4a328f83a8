#include "frame_reader.h"

#include <utility>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {

sensor_msgs::PointCloud2ConstPtr FrameReader::take(std::uint64_t frame) {
  if (!ahead_ || ahead_->frame != frame) return bag_.read(frame);
  const Ahead ahead = std::move(*ahead_);
  ahead_.reset();
  if (ahead.error) std::rethrow_exception(ahead.error);
  return ahead.cloud;
}

sensor_msgs::PointCloud2ConstPtr FrameReader::look_ahead(std::uint64_t frame) {
  ahead_.emplace(Ahead{frame, nullptr, nullptr});
  try {
    ahead_->cloud = bag_.read(frame);
  } catch (const InputError&) {
    ahead_->error = std::current_exception();
  }
  return ahead_->cloud;
}

}  // namespace particle_surface_tracker
