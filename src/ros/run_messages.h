#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <set>
#include <string>

#include "stopwatch.h"

namespace particle_surface_tracker {

/// What a run says on its error stream: warnings, each on a line of its own, and a line of progress that they do not
/// tear.
class RunMessages {
 public:
  /// \param progress whether the stream is a terminal on which a line can be rewritten.
  RunMessages(std::ostream& err, bool warnings, bool progress);
  ~RunMessages();

  void warn(const std::string& text);
  /// Says what may be true of every frame in the first one only.
  void warn_once(std::uint64_t frame, const std::string& text);
  /// \param real_time_factor as RunFacts::real_time_factor().
  void show_progress(std::size_t done, std::size_t total, std::uint64_t frame, std::optional<double> real_time_factor);
  void end_progress();

 private:
  std::ostream& err_;
  bool warnings_;
  bool progress_;
  bool line_open_ = false;
  std::set<std::string> said_;
  Stopwatch elapsed_;
};

/// The text without line breaks.
std::string one_line(std::string text);

}  // namespace particle_surface_tracker
