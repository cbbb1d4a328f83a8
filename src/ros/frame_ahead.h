#pragma once

#include <future>
#include <memory>

#include <sensor_msgs/PointCloud2.h>

#include "particle_surface_tracker/core/frame_report.h"
#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/particle_frame.h"

namespace particle_surface_tracker {

/// What of a frame needs nothing of the frames before.
struct PreparedFrame {
  ParticleFrame particles;
  std::shared_ptr<const ImplicitSurface> surface;  ///< Null: not made yet, or there are no particles.
  std::vector<FrameReport::StageTime> times;       ///< That the surface took.
};

/// A frame that is prepared on a thread of its own, while the one before it is tracked. That thread shares TBB's
/// workers with the others, but never takes over their work, so that neither waits for the other in the middle of a
/// stage.
class FrameAhead {
 public:
  FrameAhead(sensor_msgs::PointCloud2ConstPtr cloud, const Parameters& parameters);

  bool is_for(const sensor_msgs::PointCloud2& cloud) const { return cloud_.get() == &cloud; }

  /// Waits until the frame is prepared. To be called once.
  /// \throw InputError, ParticleError as to_particle_frame(), and whatever make_implicit_surface() throws.
  PreparedFrame take() { return prepared_.get(); }

 private:
  sensor_msgs::PointCloud2ConstPtr cloud_;
  std::future<PreparedFrame> prepared_;  // Its destructor waits.
};

}  // namespace particle_surface_tracker
