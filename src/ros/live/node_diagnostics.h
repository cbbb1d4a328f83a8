#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <string>

#include <diagnostic_updater/diagnostic_updater.h>
#include <particle_surface_tracker/TrackerStatus.h>
#include <ros/ros.h>

#include "particle_surface_tracker/core/frame_report.h"

namespace particle_surface_tracker {

/// When diagnostics are published and what they complain of.
struct DiagnosticOptions {
  double period = 1.0;      ///< [s] of wall time.
  double late_after = 1.0;  ///< A latency above this is a warning [s].
};

/// What the node tells /diagnostics about input, tracking and surface. Levels are those of the interval since the last
/// message; counts are those since the node came up, so that nothing is lost between two messages.
class NodeDiagnostics {
 public:
  /// \param private_handle its namespace is the name of the node.
  NodeDiagnostics(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                  const DiagnosticOptions& options);
  ~NodeDiagnostics();

  /// A cloud has arrived. Any thread may call this and the others.
  void note_arrival();

  /// What became of a frame.
  void note(const TrackerStatus& status);

  /// A frame was tracked.
  void note(const FrameReport& report);

  /// Nothing is tracked, for this reason, until it is empty.
  void note_waiting(const std::string& reason);

  /// Parameters that wait for a reset, in words; empty if there are none.
  void note_waiting_parameters(const std::string& parameters);

  /// What failed before does not matter any more.
  void note_reset();

 private:
  using Clock = std::chrono::steady_clock;
  using Report = diagnostic_updater::DiagnosticStatusWrapper;

  /// What happened in an interval.
  struct Interval {
    std::size_t arrivals = 0;
    std::size_t tracked = 0;
    double longest_latency = 0.0;          // [s]
    double tracking_time = 0.0;            // Sum [s].
    std::map<std::string, double> stages;  // Sums [s].
    std::string failure;
    std::string warning;
  };

  /// What holds until it changes.
  struct State {
    TrackerStatus status;  // The last one; its counts are those since the node came up, as those that follow.
    std::uint64_t splits = 0;
    std::uint64_t merges = 0;
    std::uint64_t remeshed_cells = 0;
    std::string failure;  // Of the last frame, if it failed.
    std::string waiting_for;
    std::string waiting_parameters;
    FrameReport report;
    bool has_mesh = false;
    Clock::time_point last_arrival = Clock::now();
  };

  void update();
  void describe_input(Report& report) const;
  void describe_tracking(Report& report) const;
  void describe_surface(Report& report) const;

  DiagnosticOptions options_;
  std::mutex mutex_;  // Of the next two.
  Interval interval_;
  State state_;

  // What is being shown, by the timer's thread alone.
  Interval shown_interval_;
  State shown_;
  TrackerStatus shown_before_;
  double shown_seconds_ = 1.0;
  Clock::time_point last_update_ = Clock::now();
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace particle_surface_tracker
