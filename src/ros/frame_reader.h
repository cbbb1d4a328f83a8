#pragma once

#include <cstdint>
#include <exception>
#include <optional>

#include "particle_surface_tracker/ros/particle_bag.h"

namespace particle_surface_tracker {

/// Reads the frames of a bag, one of them ahead of its time if that is wanted. What is wrong with it is said when its
/// time has come.
class FrameReader {
 public:
  /// \param bag outlives this object.
  explicit FrameReader(ParticleBag& bag) : bag_(bag) {}

  /// \throw InputError as ParticleBag::read().
  sensor_msgs::PointCloud2ConstPtr take(std::uint64_t frame);

  /// \return null if the frame cannot be read.
  sensor_msgs::PointCloud2ConstPtr look_ahead(std::uint64_t frame);

 private:
  struct Ahead {
    std::uint64_t frame;
    sensor_msgs::PointCloud2ConstPtr cloud;
    std::exception_ptr error;
  };

  ParticleBag& bag_;
  std::optional<Ahead> ahead_;
};

}  // namespace particle_surface_tracker
