#pragma once

#include <chrono>
#include <map>
#include <string>

namespace particle_surface_tracker {

/// Says things in the log under the name of a node, those that may come with every frame not more often than every five
/// seconds of wall time. What is held back is counted.
class ThrottledLog {
 public:
  explicit ThrottledLog(std::string name) : name_(std::move(name)) {}

  /// Every frame may say something here: nobody sees it who has not asked for it.
  void debug(const std::string& text) const;
  void info(const std::string& text) const;
  void warn(const std::string& text) const;
  void error(const std::string& text) const;

  /// \param kind what this is about; each kind has its own five seconds.
  void warn_sometimes(const std::string& kind, const std::string& text);
  void error_sometimes(const std::string& kind, const std::string& text);

 private:
  struct Kind {
    std::chrono::steady_clock::time_point silent_until{};
    std::size_t held_back = 0;
  };

  // The text with the number of those held back; empty if it has to wait.
  std::string admit(const std::string& kind, const std::string& text);

  std::string name_;
  std::map<std::string, Kind> kinds_;
};

}  // namespace particle_surface_tracker
