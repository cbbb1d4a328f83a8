#include "ros/live/tracking_worker.h"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <boost/make_shared.hpp>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/ros/particle_conversion.h"

namespace particle_surface_tracker {
namespace {

std::string stamp_of(const std_msgs::Header& header) {
  return fmt::format("stamp {}.{:09}", header.stamp.sec, header.stamp.nsec);
}

std::string count_missing(std::uint64_t count) {
  return count == 1 ? "1 frame is missing" : fmt::format("{} frames are missing", count);
}

}  // namespace

TrackingWorker::TrackingWorker(NodeOptions options, NodeOutputs& outputs, const std::string& name)
    : content_(options.content),
      outputs_(outputs),
      log_(name),
      queue_(options.queue_size, options.queue_policy),
      handler_(std::move(options.handler)),
      thread_([this] { run(); }) {}

TrackingWorker::~TrackingWorker() {
  stop();
}

void TrackingWorker::receive(const sensor_msgs::PointCloud2ConstPtr& cloud) {
  ReceivedFrame frame;
  frame.header = cloud->header;
  try {
    check_particle_cloud(*cloud);
    frame.cloud = cloud;
  } catch (const InputError& error) {
    frame.reception = Reception::kInvalid;
    frame.reason = error.what();
  }
  queue_.push(std::move(frame));
}

void TrackingWorker::reset() {
  queue_.push(FrameQueue::Command([this] {
    log_.info("reset; the next frame starts the tracker");
    forget_run();
  }));
}

void TrackingWorker::set_parameters(const Parameters& parameters, std::function<void()> refuse) {
  queue_.push(FrameQueue::Command([this, parameters, refuse = std::move(refuse)] {
    try {
      const std::vector<std::string> waiting = handler_.set_parameters(parameters);
      if (!waiting.empty()) {
        log_.warn(
            fmt::format("{} cannot change while a mesh is being tracked; the new value waits for the next reset "
                        "(service ~reset)",
                        fmt::join(waiting, ", ")));
      }
    } catch (const ParameterError& error) {
      log_.warn(fmt::format("refused: {}", error.what()));
      refuse();
    }
  }));
}

void TrackingWorker::stop() {
  queue_.close();
  if (thread_.joinable()) thread_.join();
}

void TrackingWorker::run() {
  while (!queue_.closed()) {
    if (const auto frame = queue_.pop(outputs_.marker_due())) {
      process(*frame);
    } else if (!queue_.closed()) {
      outputs_.publish_due_marker();
    }
  }
}

void TrackingWorker::process(const ReceivedFrame& frame) {
  ++counts_.frames_received;
  TrackerStatus status;
  if (frame.reception == Reception::kUsable) {
    process_usable(frame, status);
  } else {
    process_unusable(frame, status);
  }
  publish(frame, std::move(status));
}

void TrackingWorker::process_unusable(const ReceivedFrame& frame, TrackerStatus& status) {
  sequence_.pass_over();
  status.reason = frame.reason;
  switch (frame.reception) {
    case Reception::kDropped:
      status.state = TrackerStatus::DROPPED;
      ++counts_.frames_dropped;
      log_.warn_sometimes("dropped",
                          fmt::format("dropped the frame of {}: {}; {} so far. Slow the input down (rosbag play "
                                      "--rate-control-topic), or raise ~queue_size",
                                      stamp_of(frame.header), frame.reason, counts_.frames_dropped));
      break;
    case Reception::kReplaced:
      status.state = TrackerStatus::SKIPPED;
      ++counts_.frames_skipped;
      break;
    default:
      status.state = TrackerStatus::INVALID;
      ++counts_.frames_invalid;
      log_.warn_sometimes("invalid",
                          fmt::format("cannot use the frame of {}: {}", stamp_of(frame.header), frame.reason));
  }
}

void TrackingWorker::process_usable(const ReceivedFrame& frame, TrackerStatus& status) {
  if (!admit(frame, status)) return;
  try {
    track(frame, status);
  } catch (const InputError& error) {
    status.reason = error.what();
  } catch (const ParticleError& error) {
    status.reason = error.what();
  } catch (const std::exception& error) {
    status.state = TrackerStatus::FAILED;
    status.reason = error.what();
    ++counts_.frames_failed;
    log_.error_sometimes("failed",
                         fmt::format("cannot track the frame of {}: {}", stamp_of(frame.header), error.what()));
    return;
  }
  if (status.reason.empty()) return;
  status.state = TrackerStatus::INVALID;
  ++counts_.frames_invalid;
  log_.warn_sometimes("invalid", fmt::format("cannot use the frame of {}: {}", stamp_of(frame.header), status.reason));
}

bool TrackingWorker::admit(const ReceivedFrame& frame, TrackerStatus& status) {
  using Verdict = InputSequence::Verdict;
  const InputSequence::Judgement judgement = sequence_.judge(frame.header);
  status.frame = judgement.index;
  switch (judgement.verdict) {
    case Verdict::kRepeated:
    case Verdict::kLate:
      status.state = TrackerStatus::SKIPPED;
      status.reason = judgement.verdict == Verdict::kRepeated ? "its stamp is that of the frame before"
                                                              : "its stamp is below that of the frame before";
      ++counts_.frames_skipped;
      log_.warn_sometimes("skipped", fmt::format("skipped the frame of {}: {}; {} so far", stamp_of(frame.header),
                                                 status.reason, counts_.frames_skipped));
      return false;
    case Verdict::kWentBack:
      log_.warn(fmt::format("the time went back, to {}: the tracker starts again", stamp_of(frame.header)));
      break;
    case Verdict::kOtherFrameId:
      log_.warn(fmt::format("frame_id changed, to '{}': the tracker starts again", frame.header.frame_id));
      break;
    case Verdict::kFirst:
    case Verdict::kNext:
      break;
  }
  if (judgement.verdict != Verdict::kNext) {
    ++counts_.run;
    handler_.reset();
    outputs_.clear();
  }
  if (judgement.missing > 0) {
    counts_.frames_missing += judgement.missing;
    status.warnings.push_back(count_missing(judgement.missing) + " before this one");
    log_.warn_sometimes(
        "missing", fmt::format("{} before {}; {} so far. What is lost on the way: raise ~queue_size, and the queue "
                               "of the publisher",
                               count_missing(judgement.missing), stamp_of(frame.header), counts_.frames_missing));
  }
  return true;
}

void TrackingWorker::track(const ReceivedFrame& frame, TrackerStatus& status) {
  const bool is_first = !handler_.started();
  const FrameReport report = handler_.handle(*frame.cloud, status.frame);
  auto mesh = boost::make_shared<TrackedMesh>(handler_.message(content_));
  status.state = is_first ? TrackerStatus::STARTED : TrackerStatus::TRACKED;
  status.topology_version = mesh->topology_version;
  describe(report, status);
  outputs_.publish(std::move(mesh));
  ++counts_.frames_tracked;
  if (is_first) {
    log_.info(fmt::format("tracking from {} on: {} particles, spacing {:.6g} m, {} vertices, {} triangles",
                          stamp_of(frame.header), report.particles, handler_.tracker().parameters().particle_spacing,
                          report.vertices, report.triangles));
  }
  for (const std::string& warning : report.warnings) {
    log_.warn_sometimes("tracking", fmt::format("frame of {}: {}", stamp_of(frame.header), warning));
  }
}

void TrackingWorker::describe(const FrameReport& report, TrackerStatus& status) const {
  status.warnings.insert(status.warnings.end(), report.warnings.begin(), report.warnings.end());
  status.tracking_time = report.total_time;
  status.particles = static_cast<std::uint32_t>(report.particles);
  status.vertices = static_cast<std::uint32_t>(report.vertices);
  status.triangles = static_cast<std::uint32_t>(report.triangles);
  status.components = static_cast<std::uint32_t>(report.components);
  status.flagged_vertices = static_cast<std::uint32_t>(report.flagged_vertices);
  status.flagged_cells = static_cast<std::uint32_t>(report.flagged_cells);
  status.original_vertices = static_cast<std::uint32_t>(report.original_vertices_alive);
  status.volume = report.volume;
  status.implicit_volume = report.implicit_volume;
}

void TrackingWorker::forget_run() {
  sequence_.reset();
  handler_.reset();
  outputs_.clear();
}

void TrackingWorker::publish(const ReceivedFrame& frame, TrackerStatus status) {
  status.header = frame.header;
  status.run = counts_.run;
  status.frames_received = counts_.frames_received;
  status.frames_tracked = counts_.frames_tracked;
  status.frames_skipped = counts_.frames_skipped;
  status.frames_dropped = counts_.frames_dropped;
  status.frames_invalid = counts_.frames_invalid;
  status.frames_failed = counts_.frames_failed;
  status.frames_missing = counts_.frames_missing;
  status.queue_length = static_cast<std::uint32_t>(queue_.size());
  status.latency = std::chrono::duration<double>(std::chrono::steady_clock::now() - frame.arrival).count();
  outputs_.publish(boost::make_shared<const TrackerStatus>(std::move(status)));
}

}  // namespace particle_surface_tracker
