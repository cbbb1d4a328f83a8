#pragma once

#include <cstdint>
#include <future>
#include <map>

#include "particle_surface_tracker/ros/particle_bag.h"

namespace particle_surface_tracker {

/// Reads the frames of a bag, if wanted ahead of their time. What is wrong with one is said when its time has come.
class FrameReader {
 public:
  /// \param bag outlives this object, and is read by it only.
  explicit FrameReader(ParticleBag& bag) : bag_(bag) {}

  /// \throw InputError as ParticleBag::read().
  sensor_msgs::PointCloud2ConstPtr take(std::uint64_t frame);

  /// Waits for a frame that take() will be asked for later.
  /// \return null if it cannot be read.
  sensor_msgs::PointCloud2ConstPtr look_ahead(std::uint64_t frame);

  /// Begins to read a frame on a thread of its own. Nothing else may be read until it has been waited for.
  void prefetch(std::uint64_t frame);

 private:
  using Reading = std::shared_future<sensor_msgs::PointCloud2ConstPtr>;

  ParticleBag& bag_;
  std::map<std::uint64_t, Reading> ahead_;
};

}  // namespace particle_surface_tracker
