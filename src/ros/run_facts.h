#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>

#include "particle_surface_tracker/core/frame_report.h"

namespace particle_surface_tracker {

/// What a run has to say of all its frames together, beside their number and times.
class RunFacts {
 public:
  /// A frame was tracked.
  void note(const FrameReport& report);

  /// How many times as fast as the liquid itself the run is: the time between its first and last stamp over the time
  /// that it took. None before there are two frames, or where the stamps do not go forward.
  /// \param elapsed [s], positive.
  std::optional<double> real_time_factor(double elapsed) const;

  /// Prints changes of topology, the worst triangle, the longest frame, and what the bag lacks. Prints nothing without
  /// a frame.
  void print(std::ostream& out) const;

 private:
  struct Extreme {
    double value = 0.0;
    std::uint64_t frame = 0;
  };

  void print_surface(std::ostream& out) const;

  std::optional<std::int64_t> first_stamp_;  // [ns]
  std::int64_t last_stamp_ = 0;              // [ns]
  FrameReport::Topology topology_;           // Sums of what is printed.
  std::optional<Extreme> smallest_angle_;    // [deg]
  Extreme longest_;                          // [s]
  std::size_t gaps_ = 0;
  std::uint64_t missing_frames_ = 0;
};

}  // namespace particle_surface_tracker
