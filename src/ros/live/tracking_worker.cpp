#include "ros/live/tracking_worker.h"

#include <utility>

#include <fmt/format.h>
#include <boost/make_shared.hpp>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "ros/live/frame_description.h"
#include "ros/particle_attributes.h"

namespace particle_surface_tracker {

TrackingWorker::TrackingWorker(NodeOptions options, NodeOutputs& outputs, NodeDiagnostics& diagnostics,
                               SurfaceTopics* surfaces, const std::string& name)
    : content_(options.content),
      interpolate_(options.interpolate),
      outputs_(outputs),
      diagnostics_(diagnostics),
      log_(name),
      queue_(options.queue_size, options.queue_policy),
      admission_(options.queue_policy, log_),
      configured_(options.configured),
      wanted_(options.handler.parameters),
      estimates_spacing_(options.handler.estimate_spacing),
      handler_(std::move(options.handler)),
      keeper_(options.checkpoint, log_),
      awaits_mesh_(options.mesh_from_topic) {
  if (surfaces != nullptr) join_surfaces(*surfaces);
  queue_.push(FrameQueue::Command([this] {
    keeper_.resume([this](const Checkpoint& checkpoint) { take_over(checkpoint); });
    update_waiting();
  }));
  thread_ = std::thread([this] { run(); });
}

TrackingWorker::~TrackingWorker() {
  stop();
}

void TrackingWorker::receive(const sensor_msgs::PointCloud2ConstPtr& cloud) {
  diagnostics_.note_arrival();
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
  if (waits_) queue_.push(FrameQueue::Command([this] { publish_waiting(); }));
}

void TrackingWorker::reset() {
  queue_.push(FrameQueue::Command([this] {
    log_.info("reset; the next frame starts the tracker");
    admission_.reset();
    diagnostics_.note_reset();
    forget_run();
    update_waiting();
  }));
}

void TrackingWorker::pause(bool paused) {
  queue_.push(FrameQueue::Command([this, paused] {
    if (paused_ == paused) return;
    paused_ = paused;
    log_.info(paused ? "paused; frames wait" : "goes on");
    update_waiting();
  }));
}

void TrackingWorker::set_initial_mesh(TriangleMesh mesh) {
  queue_.push(FrameQueue::Command([this, mesh = std::move(mesh)] {
    log_.info(fmt::format("a mesh to begin with has come: {} vertices, {} triangles{}", mesh.vertex_count(),
                          mesh.triangle_count(), handler_.started() ? "; it is used after the next reset" : ""));
    handler_.set_mesh(mesh);
    if (!std::exchange(awaits_mesh_, false)) return;
    update_waiting();
  }));
}

void TrackingWorker::stop() {
  queue_.close();
  if (thread_.joinable()) thread_.join();
}

void TrackingWorker::run() {
  while (!queue_.closed()) {
    if (const auto frame = queue_.pop(outputs_.markers_due())) {
      process(*frame);
    } else if (!queue_.closed()) {
      outputs_.publish_due_markers();
    }
  }
  keeper_.finish([this] { return state(); });
}

void TrackingWorker::process(const ReceivedFrame& frame) {
  TrackerStatus status;
  const FrameAdmission::Verdict verdict = admission_.judge(frame, status);
  if (verdict == FrameAdmission::Verdict::kBeginsRun) forget_run();
  if (verdict != FrameAdmission::Verdict::kRefused) try_to_track(frame, status);
  admission_.conclude(frame, status);
  describe_counts(status);
  const bool is_tracked = status.state == TrackerStatus::STARTED || status.state == TrackerStatus::TRACKED;
  publish(frame, std::move(status));
  if (is_tracked) keeper_.note_frame([this] { return state(); });
  // Whoever goes by what waits learns what became of the rest.
  if (frame.is_ahead) publish_waiting();
}

void TrackingWorker::try_to_track(const ReceivedFrame& frame, TrackerStatus& status) {
  try {
    track(frame, status);
    return;
  } catch (const InputError& error) {
    status.state = TrackerStatus::INVALID;
    status.reason = error.what();
  } catch (const ParticleError& error) {
    status.state = TrackerStatus::INVALID;
    status.reason = error.what();
  } catch (const std::exception& error) {
    status.state = TrackerStatus::FAILED;
    status.reason = error.what();
  }
}

void TrackingWorker::track(const ReceivedFrame& frame, TrackerStatus& status) {
  const bool is_first = !handler_.started();
  if (is_first && awaits_mesh_)
    throw TrackingError("the mesh to begin with has not come on the topic initial_mesh yet");
  const std::uint32_t first_new_id = is_first ? 0 : handler_.tracker().mesh().next_id();
  number_ = frame.header.seq;
  is_joined_ = false;
  handler_.record_topology_cells(outputs_.shows_topology());
  const FrameReport report = handler_.handle(*frame.cloud, status.frame);
  ++(is_joined_ ? surfaces_joined_ : surfaces_own_);
  status.state = is_first ? TrackerStatus::STARTED : TrackerStatus::TRACKED;
  describe(report, status);
  const auto view = make_view(frame, report, first_new_id, status);
  last_mesh_ = view->mesh;
  diagnostics_.note(report);
  outputs_.publish(view);
  say(frame, report, status);
}

std::shared_ptr<const TrackedView> TrackingWorker::make_view(const ReceivedFrame& frame, const FrameReport& report,
                                                             std::uint32_t first_new_id, TrackerStatus& status) {
  auto mesh = boost::make_shared<TrackedMesh>(handler_.message(content_));
  status.topology_version = mesh->topology_version;
  add_interpolated(*frame.cloud, *mesh, status);
  auto view = std::make_shared<TrackedView>(view_of(handler_.tracker(), report, first_new_id));
  view->mesh = std::move(mesh);
  view->events = handler_.topology_events();
  return view;
}

void TrackingWorker::add_interpolated(const sensor_msgs::PointCloud2& cloud, TrackedMesh& mesh, TrackerStatus& status) {
  if (interpolate_.empty() || cloud.data.empty()) return;
  const ParticleAttributes attributes = read_particle_attributes(cloud, interpolate_);
  for (const std::string& missing : attributes.missing) {
    status.warnings.push_back(missing);
    log_.warn_sometimes("interpolate", missing);
  }
  const Tracker& tracker = handler_.tracker();
  mesh.interpolated = interpolate(attributes, tracker.mesh().positions(), tracker.parameters().particle_spacing);
}

void TrackingWorker::say(const ReceivedFrame& frame, const FrameReport& report, const TrackerStatus& status) {
  const std::string stamp = fmt::format("stamp {}.{:09}", frame.header.stamp.sec, frame.header.stamp.nsec);
  log_.debug(fmt::format("frame {} of {}: {} vertices, {} flagged, {} splits, {} merges, {:.3g} s", status.frame, stamp,
                         report.vertices, report.flagged_vertices, status.splits, status.merges, report.total_time));
  if (status.state == TrackerStatus::STARTED) {
    log_.info(fmt::format("tracking from {} on: {} particles, spacing {:.6g} m, {} vertices, {} triangles", stamp,
                          report.particles, handler_.tracker().parameters().particle_spacing, report.vertices,
                          report.triangles));
  }
  for (const std::string& warning : report.warnings) {
    log_.warn_sometimes("tracking", fmt::format("frame of {}: {}", stamp, warning));
  }
}

void TrackingWorker::forget_run() {
  handler_.reset();
  outputs_.clear();
  last_mesh_.reset();
  update_waiting_parameters();
  keeper_.forget();
}

void TrackingWorker::join_surfaces(SurfaceTopics& surfaces) {
  handler_.set_surface_source([this, &surfaces](const ParticleFrame& particles, const Parameters& parameters) {
    auto surface = surfaces.surface_of(number_, particles, parameters);
    is_joined_ = surface != nullptr;
    return surface;
  });
}

void TrackingWorker::describe_counts(TrackerStatus& status) const {
  admission_.describe(status);
  status.surfaces_joined = surfaces_joined_;
  status.surfaces_own = surfaces_own_;
}

std::string TrackingWorker::waiting_for() const {
  if (paused_) return "paused: frames wait until ~pause is called with false";
  if (awaits_mesh_ && !handler_.started()) return "frames wait for the mesh to begin with, on the topic initial_mesh";
  return "";
}

void TrackingWorker::update_waiting() {
  const std::string reason = waiting_for();
  waits_ = !reason.empty();
  queue_.hold(waits_);
  diagnostics_.note_waiting(reason);
  publish_waiting();
}

void TrackingWorker::publish_waiting() {
  const std::string reason = waiting_for();
  if (reason.empty()) return;
  TrackerStatus status;
  status.state = TrackerStatus::WAITING;
  status.header = last_header_;
  status.reason = reason;
  status.queue_length = static_cast<std::uint32_t>(queue_.size());
  describe_counts(status);
  outputs_.publish(boost::make_shared<const TrackerStatus>(std::move(status)));
}

void TrackingWorker::publish(const ReceivedFrame& frame, TrackerStatus status) {
  // A player that is paced by WAITING is to stay where those are that wait.
  if (!frame.is_ahead) last_header_ = frame.header;
  status.header = frame.header;
  status.queue_length = static_cast<std::uint32_t>(queue_.size());
  status.latency = std::chrono::duration<double>(std::chrono::steady_clock::now() - frame.arrival).count();
  diagnostics_.note(status);
  outputs_.publish(boost::make_shared<const TrackerStatus>(std::move(status)));
}

}  // namespace particle_surface_tracker
