#include "particle_surface_tracker/ros/frame_handler.h"

#include <algorithm>
#include <utility>

#include "flat_arrays.h"
#include "frame_ahead.h"
#include "message_state.h"
#include "parameter_agreement.h"
#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/mesh_refinement.h"
#include "particle_surface_tracker/core/vertex_normals.h"
#include "particle_surface_tracker/ros/mesh_conversion.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "particle_surface_tracker/ros/time_conversion.h"
#include "vertex_velocities.h"

namespace particle_surface_tracker {

namespace {

/// How near to the mesh a piece is that has joined it and not vanished [r].
constexpr double kReachOfMerges = 2.0;

void check(Parameters parameters, bool estimate_spacing) {
  // The other parameters can be judged before the spacing is known.
  if (estimate_spacing) parameters.particle_spacing = 1.0;
  check_parameters(parameters);
}

}  // namespace

FrameHandler::FrameHandler(FrameHandlerOptions options)
    : options_(std::move(options)), before_(std::make_unique<VertexPlaces>()) {
  check(options_.parameters, options_.estimate_spacing);
}

FrameHandler::~FrameHandler() = default;

FrameReport FrameHandler::handle(const sensor_msgs::PointCloud2& cloud, std::uint64_t frame_index) {
  PreparedFrame prepared = prepare(cloud);
  const std::int64_t stamp_ns = prepared.particles.stamp_ns;
  if (started()) tracker_->record_topology_cells(records_cells_);
  const bool is_first = !started();
  VertexPlaces places;
  std::shared_ptr<const VertexComponents> components;
  if (!is_first) {
    places = {tracker_->mesh().ids(), tracker_->mesh().positions()};
    components = tracker_->mesh().components();
  }
  FrameReport report = is_first ? start(prepared.particles, frame_index) : advance(std::move(prepared), frame_index);
  events_.clear();
  if (!is_first) find_events(places, *components, report);
  *before_ = std::move(places);
  seconds_ = is_first ? 0.0 : 1e-9 * static_cast<double>(stamp_ns - to_nanoseconds(header_.stamp));
  header_ = cloud.header;
  if (connectivity_ != tracker_->mesh().connectivity()) {
    connectivity_ = tracker_->mesh().connectivity();
    ++topology_version_;
  }
  return report;
}

PreparedFrame FrameHandler::prepare(const sensor_msgs::PointCloud2& cloud) {
  if (ahead_ != nullptr && ahead_->is_for(cloud)) {
    const std::unique_ptr<FrameAhead> ahead = std::move(ahead_);
    return ahead->take();
  }
  PreparedFrame prepared{to_particle_frame(cloud), nullptr, {}};
  if (surface_source_ && started() && !prepared.particles.empty()) {
    prepared.surface = surface_source_(prepared.particles, tracker_->parameters());
  }
  return prepared;
}

FrameReport FrameHandler::advance(PreparedFrame prepared, std::uint64_t frame_index) {
  FrameReport report = tracker_->advance(prepared.particles, frame_index, std::move(prepared.surface));
  report.times.insert(report.times.begin(), prepared.times.begin(), prepared.times.end());
  return report;
}

void FrameHandler::find_events(const VertexPlaces& before, const VertexComponents& components, FrameReport& report) {
  FrameReport::Topology& topology = report.topology;
  if (topology.remeshed_cells + topology.removed_components == 0) return;
  const TriangleMesh& mesh = tracker_->mesh();
  events_ = find_topology_events({before.ids, before.positions, components},
                                 {mesh.ids(), mesh.positions(), *mesh.components()},
                                 kReachOfMerges * tracker_->parameters().particle_spacing);
  for (const TopologyEvent& event : events_) {
    ++(event.kind == TopologyEvent::Kind::kSplit   ? topology.splits
       : event.kind == TopologyEvent::Kind::kMerge ? topology.merges
                                                   : topology.gone);
  }
}

void FrameHandler::look_ahead(const sensor_msgs::PointCloud2ConstPtr& cloud) {
  // The spacing may only be known once the first frame is.
  if (started()) ahead_ = std::make_unique<FrameAhead>(cloud, tracker_->parameters());
}

void FrameHandler::record_topology_cells(bool on) {
  records_cells_ = on;
}

void FrameHandler::save(Checkpoint& checkpoint) const {
  checkpoint.tracker = tracker_->state();
  checkpoint.sections[message_section] = to_bytes(MessageState{header_, seconds_, *before_, topology_version_});
}

void FrameHandler::load(const Checkpoint& checkpoint) {
  require_agreement(checkpoint.tracker.parameters, options_.parameters, Agreement::kWhatNeedsReset,
                    /*any_spacing*/ options_.estimate_spacing);
  const auto section = checkpoint.sections.find(message_section);
  if (section == checkpoint.sections.end())
    throw InputError("the checkpoint does not say which message it was made of");
  MessageState state = message_state_from(section->second);
  Parameters parameters = options_.parameters;
  parameters.particle_spacing = checkpoint.tracker.parameters.particle_spacing;
  Tracker tracker(checkpoint.tracker);
  tracker.set_parameters(parameters);

  reset();
  connectivity_ = tracker.mesh().connectivity();
  tracker_.emplace(std::move(tracker));
  header_ = std::move(state.header);
  seconds_ = state.seconds;
  *before_ = std::move(state.before);
  topology_version_ = std::max(topology_version_ + 1, state.topology_version);
}

FrameReport FrameHandler::start(const ParticleFrame& frame, std::uint64_t frame_index) {
  if (frame.empty()) throw ParticleError("the first frame has no particles to start from");
  Parameters parameters = options_.parameters;
  if (options_.estimate_spacing) parameters.particle_spacing = estimate_particle_spacing(frame);
  Tracker tracker(parameters);
  tracker.record_topology_cells(records_cells_);
  FrameReport report;
  if (options_.mesh) {
    TriangleMesh mesh = *options_.mesh;
    if (options_.refine_mesh) split_long_edges(mesh, parameters.particle_spacing);
    report = tracker.start(mesh, frame, frame_index);
  } else {
    report = tracker.start_from_particles(frame, frame_index);
  }
  tracker_.emplace(std::move(tracker));
  return report;
}

void FrameHandler::reset() {
  ahead_.reset();
  tracker_.reset();
  *before_ = {};
  events_.clear();
  // The next mesh gets a new version, for whoever knows the triangles of this one.
  connectivity_ = 0;
}

std::vector<std::string> FrameHandler::set_parameters(const Parameters& parameters) {
  check(parameters, options_.estimate_spacing);
  std::vector<std::string> waiting;
  if (started()) {
    const Parameters& current = tracker_->parameters();
    Parameters applicable = parameters;
    for (const ParameterInfo& info : parameter_table()) {
      if (!info.needs_reset) continue;
      const std::string value = get_parameter(current, info.name);
      const bool is_estimated = options_.estimate_spacing && info.name == "particle_spacing";
      if (!is_estimated && get_parameter(parameters, info.name) != value) waiting.push_back(info.name);
      set_parameter(applicable, info.name, value);
    }
    tracker_->set_parameters(applicable);
  }
  options_.parameters = parameters;
  return waiting;
}

TrackedMesh FrameHandler::message(const MessageContent& content) const {
  const TriangleMesh& mesh = tracker_->mesh();
  TrackedMesh message = to_tracked_mesh(header_, mesh, topology_version_);
  if (content.normals) message.normals = flat<float>(vertex_normals(mesh.positions(), mesh.triangles()));
  // Frames that share a stamp have no time between them.
  if (content.velocities && seconds_ > 0.0)
    message.velocities = flat<float>(vertex_velocities(*before_, mesh, seconds_));
  return message;
}

}  // namespace particle_surface_tracker
