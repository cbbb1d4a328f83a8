#include "particle_surface_tracker/ros/frame_handler.h"

#include <utility>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/mesh_refinement.h"
#include "particle_surface_tracker/ros/mesh_conversion.h"
#include "particle_surface_tracker/ros/particle_conversion.h"

namespace particle_surface_tracker {

FrameHandler::FrameHandler(FrameHandlerOptions options) : options_(std::move(options)) {
  // The other parameters can be judged before the spacing is known.
  Parameters parameters = options_.parameters;
  if (options_.estimate_spacing) parameters.particle_spacing = 1.0;
  check_parameters(parameters);
}

FrameReport FrameHandler::handle(const sensor_msgs::PointCloud2& cloud, std::uint64_t frame_index) {
  const ParticleFrame frame = to_particle_frame(cloud);
  FrameReport report = started() ? tracker_->advance(frame, frame_index) : start(frame, frame_index);
  header_ = cloud.header;
  if (triangles_ != tracker_->mesh().triangles()) {
    triangles_ = tracker_->mesh().triangles();
    ++topology_version_;
  }
  return report;
}

FrameReport FrameHandler::start(const ParticleFrame& frame, std::uint64_t frame_index) {
  if (frame.empty()) throw ParticleError("the first frame has no particles to start from");
  Parameters parameters = options_.parameters;
  if (options_.estimate_spacing) parameters.particle_spacing = estimate_particle_spacing(frame);
  Tracker tracker(parameters);
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

TrackedMesh FrameHandler::message() const {
  return to_tracked_mesh(header_, tracker_->mesh(), topology_version_);
}

}  // namespace particle_surface_tracker
