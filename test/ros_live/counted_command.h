#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace particle_surface_tracker::test {

/// A command of ROS that a test starts, such as roslaunch or rosbag, in a process group of its own. It is interrupted
/// at the end of this object, and waited for.
class Command {
 public:
  explicit Command(std::vector<std::string> words);
  ~Command();
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  bool running();

 private:
  pid_t process_;
  bool has_ended_ = false;
};

/// roslaunch of a launch file of this package, without rviz.
std::vector<std::string> launch(const std::string& file, const std::vector<std::string>& arguments);

}  // namespace particle_surface_tracker::test
