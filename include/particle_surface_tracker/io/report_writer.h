#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "particle_surface_tracker/core/frame_report.h"

namespace particle_surface_tracker {

class FileDescriptor;

/// One frame's report as a JSON object on one line. Numbers that are not finite become null. The stamp is in seconds
/// with all nine decimals, more than a double holds: read it as a decimal number where nanoseconds matter.
std::string report_line(const FrameReport& report);

/// The line of a frame that could not be used: {"frame": …, "error": …}.
std::string report_error_line(std::uint64_t frame, const std::string& error);

/// Writes reports to a file as JSON lines. Every line is handed to the system as a whole, before the next frame begins,
/// so that a run that ends in whatever way leaves a readable report.
class ReportWriter {
 public:
  /// Starts the file afresh.
  /// \throw OutputError if it cannot be written.
  explicit ReportWriter(std::string path);

  /// Goes on with a file that is there: cuts off what follows its first `kept_bytes` bytes.
  /// \throw InputError if the file is not there or shorter, so that it cannot be the report of that run.
  /// \throw OutputError if it cannot be written.
  ReportWriter(std::string path, std::uint64_t kept_bytes);

  ~ReportWriter();

  /// \throw OutputError if the line cannot be written.
  void write(const FrameReport& report);

  /// \throw OutputError if the line cannot be written.
  void write_error(std::uint64_t frame, const std::string& error);

  /// Length of the file so far.
  std::uint64_t bytes() const { return bytes_; }

 private:
  void write_line(std::string line);

  std::string path_;
  std::unique_ptr<FileDescriptor> file_;
  std::uint64_t bytes_ = 0;
};

}  // namespace particle_surface_tracker
