#pragma once

#include <cstdint>
#include <fstream>
#include <string>

#include "particle_surface_tracker/core/frame_report.h"

namespace particle_surface_tracker {

/// One frame's report as a JSON object on one line. Numbers that are not finite become null. The stamp is in seconds
/// with all nine decimals, more than a double holds: read it as a decimal number where nanoseconds matter.
std::string report_line(const FrameReport& report);

/// The line of a frame that could not be used: {"frame": …, "error": …}.
std::string report_error_line(std::uint64_t frame, const std::string& error);

/// Writes reports to a file as JSON lines. Every line reaches the file before the next frame begins, so that an
/// interrupted run leaves a readable report.
class ReportWriter {
 public:
  /// Starts the file afresh.
  /// \throw OutputError if it cannot be written.
  explicit ReportWriter(std::string path);

  /// \throw OutputError if the line cannot be written.
  void write(const FrameReport& report);

  /// \throw OutputError if the line cannot be written.
  void write_error(std::uint64_t frame, const std::string& error);

 private:
  void write_line(const std::string& line);

  std::string path_;
  std::ofstream file_;
};

}  // namespace particle_surface_tracker
