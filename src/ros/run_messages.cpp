#include "run_messages.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace particle_surface_tracker {
namespace {

constexpr const char* erase_line = "\r\033[K";

std::string minutes_and_seconds(double seconds) {
  const auto whole = std::lround(seconds);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

RunMessages::RunMessages(std::ostream& err, bool warnings, bool progress)
    : err_(err), warnings_(warnings), progress_(progress) {}

RunMessages::~RunMessages() {
  end_progress();
}

void RunMessages::warn(const std::string& text) {
  if (!warnings_) return;
  end_progress();
  err_ << "track_bag: warning: " << one_line(text) << '\n' << std::flush;
}

void RunMessages::warn_once(std::uint64_t frame, const std::string& text) {
  if (said_.insert(text).second) warn(fmt::format("frame {}: {}; not said again", frame, text));
}

void RunMessages::show_progress(std::size_t done, std::size_t total, std::uint64_t frame,
                                std::optional<double> real_time_factor) {
  if (!progress_ || done == 0) return;
  const double rate = static_cast<double>(done) / std::max(elapsed_.seconds(), 1e-9);
  const std::string factor = real_time_factor ? fmt::format(", {:.2g} x real time", *real_time_factor) : "";
  err_ << erase_line
       << fmt::format("frame {}: {}/{}, {:.1f} frames/s{}, {} left", frame, done, total, rate, factor,
                      minutes_and_seconds(static_cast<double>(total - done) / rate))
       << std::flush;
  line_open_ = true;
}

void RunMessages::end_progress() {
  if (line_open_) err_ << erase_line << std::flush;
  line_open_ = false;
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::replace(text.begin(), text.end(), '\r', ' ');
  return text;
}

}  // namespace particle_surface_tracker
