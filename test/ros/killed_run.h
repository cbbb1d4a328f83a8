#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "support/temporary_folder.h"

namespace particle_surface_tracker::test {

/// Runs of the program track_bag on a small bag in which two drops merge, that may be killed at any moment.
class KilledRun {
 public:
  static constexpr int frames = 16;

  /// Writes the bag.
  KilledRun();

  /// Runs the program, with its outputs in the folder `name`, until its end or until it is killed.
  /// \param more arguments, which may take the place of standard ones; @ stands for that folder.
  /// \param kill_now is asked again and again.
  /// \return its exit code, or −1 if it was killed.
  int run(
      const std::string& name, const std::vector<std::string>& more,
      const std::function<bool()>& kill_now = [] { return false; }) const;

  /// What the run has said on its streams.
  std::string output(const std::string& name) const;

  /// The files of a folder by name, all below it. Those of the report without what is never the same twice: times and
  /// memory. Those that are not complete yet, checkpoints and what was said are left out.
  std::map<std::string, std::string> files(const std::string& name) const;

  std::string path(const std::string& name) const { return folder_ / name; }

 private:
  TemporaryFolder folder_;
};

}  // namespace particle_surface_tracker::test
