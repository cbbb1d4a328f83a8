#pragma once

#include <cstddef>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace particle_surface_tracker {

/// Adds up the times of the stages over the frames of a run.
class StageTable {
 public:
  void add(const std::string& stage, double seconds);

  /// Prints, per stage in the order of first use: total, mean per frame, share.
  void print(std::ostream& out, std::size_t frames) const;

 private:
  std::vector<std::pair<std::string, double>> totals_;
};

/// Processor time of the process so far, all threads [s].
double process_cpu_seconds();

/// Largest resident memory of the process so far [bytes].
std::uint64_t process_peak_memory();

}  // namespace particle_surface_tracker
