#include "stage_timer.h"

#include <algorithm>

#include <sys/resource.h>

namespace particle_surface_tracker {

namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

rusage process_usage() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage;
}

double cpu_seconds() {
  const rusage usage = process_usage();
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

StageTimer::StageTimer(FrameReport& report)
    : report_(report),
      frame_start_(Clock::now()),
      stage_start_(frame_start_),
      frame_cpu_start_(cpu_seconds()),
      stage_cpu_start_(frame_cpu_start_) {}

void StageTimer::begin(const std::string& stage) {
  end_stage();
  stage_ = stage;
}

void StageTimer::end_stage() {
  const Clock::time_point now = Clock::now();
  const double cpu_now = cpu_seconds();
  if (!stage_.empty()) {
    auto entry = std::find_if(report_.times.begin(), report_.times.end(),
                              [&](const FrameReport::StageTime& time) { return time.stage == stage_; });
    if (entry == report_.times.end()) entry = report_.times.insert(entry, {stage_, 0.0, 0.0});
    entry->seconds += std::chrono::duration<double>(now - stage_start_).count();
    entry->cpu_seconds += cpu_now - stage_cpu_start_;
  }
  stage_start_ = now;
  stage_cpu_start_ = cpu_now;
}

void StageTimer::finish() {
  end_stage();
  stage_.clear();
  report_.total_time = std::chrono::duration<double>(Clock::now() - frame_start_).count();
  report_.cpu_seconds = cpu_seconds() - frame_cpu_start_;
  constexpr std::uint64_t bytes_per_kibibyte = 1024;
  report_.peak_rss_bytes = static_cast<std::uint64_t>(process_usage().ru_maxrss) * bytes_per_kibibyte;
}

}  // namespace particle_surface_tracker
