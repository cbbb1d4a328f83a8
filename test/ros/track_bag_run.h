#pragma once

#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sensor_msgs/PointCloud2.h>
#include <nlohmann/json.hpp>

#include "support/temporary_folder.h"

namespace particle_surface_tracker::test {

/// How a program ended and what it said.
struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

/// Runs of the program track_bag on a ball of liquid of radius 1 that moves by r / 16 along x in every frame.
class TrackBag : public testing::Test {
 protected:
  using Json = nlohmann::json;

  static constexpr double r = 0.2;

  /// Writes the mesh of frame 0, ball.ply.
  TrackBag();

  /// Writes in.bag, with the clouds 0 … frames − 1, each as `change` leaves it.
  void write_bag(
      int frames,
      const std::function<void(int, sensor_msgs::PointCloud2&)>& change = [](int, sensor_msgs::PointCloud2&) {}) const;

  /// Runs with these arguments; @ stands for the folder.
  /// \param before what the shell is to do first.
  Outcome run(const std::string& arguments, const std::string& before = "") const;

  /// Runs with bag, mesh, spacing and folder as they are written here, and more arguments.
  Outcome run_standard(const std::string& more = "") const;

  /// The lines of report.jsonl.
  std::vector<Json> report() const;

  /// Names of the files in a folder, in order.
  std::vector<std::string> files_in(const std::string& name) const;

  TemporaryFolder folder_;
};

/// Expects one line on the error stream that begins with the program's name and has all the words.
void expect_error(const Outcome& outcome, int code, const std::vector<std::string>& words);

}  // namespace particle_surface_tracker::test
