#include "stage_table.h"

#include <sys/resource.h>

#include <algorithm>

#include <fmt/format.h>

namespace particle_surface_tracker {
namespace {

std::string row(const std::string& stage, double seconds, std::size_t frames, double all) {
  const double mean_ms = frames == 0 ? 0.0 : 1e3 * seconds / static_cast<double>(frames);
  const double share = all > 0.0 ? 100.0 * seconds / all : 0.0;
  return fmt::format("{:<24} {:>10.3f} {:>12.2f} {:>7.1f} %\n", stage, seconds, mean_ms, share);
}

}  // namespace

void StageTable::add(const std::string& stage, double seconds) {
  const auto found =
      std::find_if(totals_.begin(), totals_.end(), [&stage](const auto& total) { return total.first == stage; });
  if (found == totals_.end()) {
    totals_.emplace_back(stage, seconds);
  } else {
    found->second += seconds;
  }
}

void StageTable::print(std::ostream& out, std::size_t frames) const {
  double all = 0.0;
  for (const auto& [stage, seconds] : totals_) all += seconds;
  out << fmt::format("{:<24} {:>10} {:>12} {:>9}\n", "stage", "total [s]", "mean [ms]", "share");
  for (const auto& [stage, seconds] : totals_) out << row(stage, seconds, frames, all);
  out << row("total", all, frames, all);
}

double process_cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::uint64_t process_peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts it in kibibytes.
}

}  // namespace particle_surface_tracker
