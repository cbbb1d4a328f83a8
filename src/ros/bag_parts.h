#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <particle_surface_tracker/TrackedMesh.h>
#include <sensor_msgs/PointCloud2.h>

#include "particle_surface_tracker/ros/tracking_bag_writer.h"

namespace particle_surface_tracker {

/// How far the bag of a run has got.
struct BagProgress {
  bool has_whole = false;   ///< The bag itself is there and comes before the parts.
  std::uint64_t parts = 0;  ///< Parts that are complete.
};

/// A bag that a run can be interrupted at and go on with. Until the run is over the bag lies in parts, each a bag by
/// itself, in a folder beside it: `out.bag.parts/part_000000.bag`, ….
class BagParts {
 public:
  /// \param from parts that are kept; all others in the folder are removed.
  /// \throw InputError if a part is not there, or the bag itself where it should be.
  /// \throw OutputError if the folder or a part cannot be written.
  BagParts(std::string path, std::string particle_topic, const BagProgress& from);

  /// \throw OutputError if the messages cannot be written.
  void write(const sensor_msgs::PointCloud2ConstPtr& particles, const TrackedMesh& mesh);

  /// Completes the part in work.
  /// \throw OutputError if it cannot be completed.
  BagProgress end_part();

  /// Joins all parts to the bag, message by message: its bytes are those that it would have if it had been written in
  /// one go. The parts are still there afterwards.
  /// \throw OutputError if the bag cannot be written.
  BagProgress join();

  /// Removes the parts, once nothing refers to them any more.
  void remove_parts();

 private:
  std::string part(std::uint64_t number) const;
  void remove_other_parts() const;
  void copy(const std::string& from, TrackingBagWriter& to) const;

  std::string path_;
  std::string folder_;
  std::string particle_topic_;
  BagProgress progress_;
  std::unique_ptr<TrackingBagWriter> in_work_;  // Null between parts.
};

}  // namespace particle_surface_tracker
