#pragma once

#include <chrono>
#include <string>

#include "particle_surface_tracker/core/frame_report.h"

namespace particle_surface_tracker {

/// Measures the stages of one frame into its report: wall and processor time of each, and at the end the totals of the
/// frame.
class StageTimer {
 public:
  explicit StageTimer(FrameReport& report);

  /// Ends the stage that runs, if any, and begins another. A stage that is begun again adds to its time.
  void begin(const std::string& stage);

  /// Ends the last stage and fills in total_time, cpu_seconds and peak_rss_bytes.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  void end_stage();

  FrameReport& report_;
  Clock::time_point frame_start_;
  Clock::time_point stage_start_;
  double frame_cpu_start_;
  double stage_cpu_start_;
  std::string stage_;
};

}  // namespace particle_surface_tracker
