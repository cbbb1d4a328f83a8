#include "ros_live/counted_command.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace particle_surface_tracker::test {

Command::Command(std::vector<std::string> words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  process_ = fork();
  if (process_ != 0) return;
  setpgid(0, 0);
  execvp(pointers[0], pointers.data());
  _exit(127);
}

Command::~Command() {
  if (!running()) return;
  kill(process_, SIGINT);
  waitpid(process_, nullptr, 0);
}

bool Command::running() {
  has_ended_ = has_ended_ || waitpid(process_, nullptr, WNOHANG) != 0;
  return !has_ended_;
}

std::vector<std::string> launch(const std::string& file, const std::vector<std::string>& arguments) {
  std::vector<std::string> words = {"roslaunch", "particle_surface_tracker", file, "rviz:=false"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

}  // namespace particle_surface_tracker::test
