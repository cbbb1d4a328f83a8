#include "ros/live/throttled_log.h"

#include <fmt/format.h>
#include <ros/console.h>

namespace particle_surface_tracker {

void ThrottledLog::debug(const std::string& text) const {
  ROS_DEBUG_STREAM(name_ << ": " << text);
}

void ThrottledLog::info(const std::string& text) const {
  ROS_INFO_STREAM(name_ << ": " << text);
}

void ThrottledLog::warn(const std::string& text) const {
  ROS_WARN_STREAM(name_ << ": " << text);
}

void ThrottledLog::error(const std::string& text) const {
  ROS_ERROR_STREAM(name_ << ": " << text);
}

void ThrottledLog::warn_sometimes(const std::string& kind, const std::string& text) {
  const std::string admitted = admit(kind, text);
  if (!admitted.empty()) warn(admitted);
}

void ThrottledLog::error_sometimes(const std::string& kind, const std::string& text) {
  const std::string admitted = admit(kind, text);
  if (!admitted.empty()) error(admitted);
}

std::string ThrottledLog::admit(const std::string& kind, const std::string& text) {
  Kind& state = kinds_[kind];
  const auto now = std::chrono::steady_clock::now();
  if (now < state.silent_until) {
    ++state.held_back;
    return "";
  }
  state.silent_until = now + std::chrono::seconds(5);
  const std::size_t held_back = state.held_back;
  state.held_back = 0;
  return held_back == 0 ? text : fmt::format("{} (and {} more of this kind before)", text, held_back);
}

}  // namespace particle_surface_tracker
