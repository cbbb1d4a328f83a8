#include "ros/live/node_diagnostics.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace particle_surface_tracker {
namespace {

using Level = diagnostic_msgs::DiagnosticStatus;

/// Periods without input after which it is stale.
constexpr double kStalePeriods = 5.0;

double seconds(std::chrono::steady_clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// Memory that the process has now [MB]; 0 where the system does not say. The manager of a nodelet holds others, too.
double resident_megabytes() {
  long pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%*s %ld", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return static_cast<double>(pages) * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

void add_count(std::string& text, std::uint64_t count, const char* what) {
  if (count == 0) return;
  text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
}

}  // namespace

NodeDiagnostics::NodeDiagnostics(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                                 const DiagnosticOptions& options)
    : options_(options), updater_(handle, private_handle, private_handle.getNamespace()) {
  updater_.setHardwareID("none");
  updater_.add("input", [this](Report& report) { describe_input(report); });
  updater_.add("tracking", [this](Report& report) { describe_tracking(report); });
  updater_.add("surface", [this](Report& report) { describe_surface(report); });
  // Not the updater's own clock: simulated time may stand still, and then nobody would be told.
  timer_ = ros::NodeHandle(handle).createWallTimer(ros::WallDuration(options_.period),
                                                   [this](const ros::WallTimerEvent&) { update(); });
}

NodeDiagnostics::~NodeDiagnostics() {
  timer_.stop();
}

void NodeDiagnostics::note_arrival() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++interval_.arrivals;
  state_.last_arrival = Clock::now();
}

void NodeDiagnostics::note(const TrackerStatus& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  state_.status = status;
  state_.splits += status.splits;
  state_.merges += status.merges;
  state_.remeshed_cells += status.remeshed_cells;
  state_.failure = status.state == TrackerStatus::FAILED ? status.reason : "";
  interval_.longest_latency = std::max(interval_.longest_latency, status.latency);
  if (!state_.failure.empty()) interval_.failure = state_.failure;
  if (!status.warnings.empty()) interval_.warning = status.warnings.back();
}

void NodeDiagnostics::note(const FrameReport& report) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++interval_.tracked;
  interval_.tracking_time += report.total_time;
  for (const FrameReport::StageTime& time : report.times) interval_.stages[time.stage] += time.seconds;
  state_.report = report;
  state_.has_mesh = true;
}

void NodeDiagnostics::note_waiting(const std::string& reason) {
  const std::lock_guard<std::mutex> lock(mutex_);
  state_.waiting_for = reason;
}

void NodeDiagnostics::note_waiting_parameters(const std::string& parameters) {
  const std::lock_guard<std::mutex> lock(mutex_);
  state_.waiting_parameters = parameters;
}

void NodeDiagnostics::note_reset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  state_.failure.clear();
  interval_.failure.clear();
  state_.has_mesh = false;
}

void NodeDiagnostics::update() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const Clock::time_point now = Clock::now();
    shown_seconds_ = std::max(seconds(now - last_update_), 1e-3);
    last_update_ = now;
    shown_before_ = shown_.status;
    shown_ = state_;
    shown_interval_ = std::exchange(interval_, {});
  }
  updater_.force_update();
}

void NodeDiagnostics::describe_input(Report& report) const {
  const TrackerStatus& status = shown_.status;
  std::string trouble;
  add_count(trouble, status.frames_missing - shown_before_.frames_missing, "missing");
  add_count(trouble, status.frames_dropped - shown_before_.frames_dropped, "dropped");
  add_count(trouble, status.frames_invalid - shown_before_.frames_invalid, "invalid");
  if (!trouble.empty()) {
    report.summary(Level::WARN, trouble);
  } else if (seconds(last_update_ - shown_.last_arrival) > kStalePeriods * options_.period) {
    report.summary(Level::STALE, "no particles arrive");
  } else {
    report.summary(Level::OK, "nothing was lost");
  }
  report.add("rate [1/s]", static_cast<double>(shown_interval_.arrivals) / shown_seconds_);
  report.add("frames received", status.frames_received);
  report.add("frames skipped", status.frames_skipped);
  report.add("frames missing", status.frames_missing);
  report.add("frames dropped", status.frames_dropped);
  report.add("frames invalid", status.frames_invalid);
}

void NodeDiagnostics::describe_tracking(Report& report) const {
  const TrackerStatus& status = shown_.status;
  const double latency = shown_interval_.longest_latency;
  const std::string& failure = shown_.failure.empty() ? shown_interval_.failure : shown_.failure;
  if (!failure.empty()) {
    report.summary(Level::ERROR, failure);
  } else if (!shown_.waiting_for.empty()) {
    report.summary(Level::WARN, shown_.waiting_for);
  } else if (latency > options_.late_after) {
    report.summary(Level::WARN, fmt::format("late by {:.3g} s; {} frames wait", latency, status.queue_length));
  } else {
    report.summary(Level::OK, shown_.has_mesh ? "in time" : "nothing is tracked yet");
  }
  const double frames = static_cast<double>(std::max<std::size_t>(shown_interval_.tracked, 1));
  report.add("rate [1/s]", static_cast<double>(shown_interval_.tracked) / shown_seconds_);
  report.add("frames tracked", status.frames_tracked);
  report.add("frames failed", status.frames_failed);
  report.add("surfaces joined", status.surfaces_joined);
  report.add("surfaces made here", status.surfaces_own);
  report.add("runs", status.run);
  report.add("frames that wait", status.queue_length);
  report.add("waits for reset", shown_.waiting_parameters.empty() ? "nothing" : shown_.waiting_parameters);
  report.add("longest latency [s]", latency);
  report.add("time of a frame [s]", shown_interval_.tracking_time / frames);
  for (const auto& [stage, time] : shown_interval_.stages) {
    report.add(fmt::format("time of {} [s]", stage), time / frames);
  }
  report.add("memory of the process [MB]", resident_megabytes());
}

void NodeDiagnostics::describe_surface(Report& report) const {
  if (!shown_interval_.warning.empty()) {
    report.summary(Level::WARN, shown_interval_.warning);
  } else {
    report.summary(Level::OK, shown_.has_mesh ? "tracked" : "there is no mesh yet");
  }
  report.add("splits", shown_.splits);
  report.add("merges", shown_.merges);
  report.add("re-meshed cells", shown_.remeshed_cells);
  if (!shown_.has_mesh) return;
  report.add("vertices", shown_.report.vertices);
  report.add("triangles", shown_.report.triangles);
  report.add("components", shown_.report.components);
  report.add("flagged vertices", shown_.report.flagged_vertices);
  report.add("volume [m^3]", shown_.report.volume);
  if (shown_.report.triangles != 0) report.add("smallest angle [deg]", shown_.report.smallest_angle);
}

}  // namespace particle_surface_tracker
