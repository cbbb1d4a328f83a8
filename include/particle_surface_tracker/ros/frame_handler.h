#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <particle_surface_tracker/TrackedMesh.h>
#include <sensor_msgs/PointCloud2.h>

#include "particle_surface_tracker/core/frame_report.h"
#include "particle_surface_tracker/core/topology_events.h"
#include "particle_surface_tracker/io/checkpoint.h"
#include "particle_surface_tracker/tracker/tracker.h"

namespace particle_surface_tracker {

/// What a FrameHandler begins with.
struct FrameHandlerOptions {
  Parameters parameters;
  bool estimate_spacing = false;     ///< Take r from the particles of the first frame, not from the parameters.
  std::optional<TriangleMesh> mesh;  ///< Bounds the liquid of the first frame; without it the implicit surface does.
  bool refine_mesh = false;          ///< Split edges of the mesh that are longer than r.
};

/// What a message carries beside the mesh itself.
struct MessageContent {
  bool normals = false;
  bool velocities = false;
};

/// Where vertices were, by id.
struct VertexPlaces;

class FrameAhead;
struct PreparedFrame;

/// Turns clouds of particles into tracked meshes: the one piece between messages and tracker, whether the messages come
/// from a topic or from a bag.
class FrameHandler {
 public:
  /// \throw ParameterError as check_parameters().
  explicit FrameHandler(FrameHandlerOptions options);
  ~FrameHandler();

  /// The first cloud starts the tracker, every other one carries the mesh on. A cloud that throws changes nothing.
  /// \throw InputError, ParticleError as to_particle_frame().
  /// \throw ParticleError if the first cloud is empty.
  /// \throw TrackingError as Tracker::start() and Tracker::advance().
  FrameReport handle(const sensor_msgs::PointCloud2& cloud, std::uint64_t frame_index);

  /// Begins to prepare the frame after the next one handled, on a thread of its own: its particles and its implicit
  /// surface need nothing of the frames before. handle() of the same message, which may be any later call, takes what
  /// was prepared, with the same result as without. One message can be ahead; another one takes its place. Before the
  /// first frame nothing is done.
  void look_ahead(const sensor_msgs::PointCloud2ConstPtr& cloud);

  /// Where the implicit surface of a frame may come from, in place of being made here.
  /// \return null: it has to be made here.
  using SurfaceSource = std::function<std::shared_ptr<const ImplicitSurface>(const ParticleFrame& particles,
                                                                             const Parameters& parameters)>;

  /// handle() asks this for the surface of every frame but the first that is not ahead.
  void set_surface_source(SurfaceSource source) { surface_source_ = std::move(source); }

  /// As Tracker::record_topology_cells(), for the frames handled from now on.
  void record_topology_cells(bool on);

  /// Puts into a checkpoint all that the next frame goes on from.
  /// \pre started().
  void save(Checkpoint& checkpoint) const;

  /// Goes on from a checkpoint as if the frames before it had been handled here. Parameters that can change while a
  /// mesh is being tracked stay as they are here; the topology version is above those that messages had here before.
  /// \throw ParameterError if one that cannot change differs, unless it is a spacing that is estimated.
  /// \throw InputError if the checkpoint lacks what save() puts into it. Whatever throws changes nothing.
  void load(const Checkpoint& checkpoint);

  /// Forgets what was tracked: the next cloud starts the tracker anew, with the mesh of the options.
  void reset();

  /// Sets the mesh to begin with, from the next start on.
  void set_mesh(TriangleMesh mesh) { options_.mesh = std::move(mesh); }

  /// Takes over new parameters. Those that cannot change while a mesh is being tracked wait for reset().
  /// \return the names of those that wait.
  /// \throw ParameterError as check_parameters(); nothing changes then.
  std::vector<std::string> set_parameters(const Parameters& parameters);

  bool started() const { return tracker_.has_value(); }

  /// The mesh, parameters and implicit surface of the last frame.
  /// \pre started().
  const Tracker& tracker() const { return *tracker_; }

  /// The pieces of the mesh that came off others, joined others or went in the last frame; none in the first.
  const std::vector<TopologyEvent>& topology_events() const { return events_; }

  /// The tracked mesh as a message, stamped and framed as the last cloud.
  /// \pre started().
  TrackedMesh message(const MessageContent& content = {}) const;

 private:
  FrameReport start(const ParticleFrame& frame, std::uint64_t frame_index);
  PreparedFrame prepare(const sensor_msgs::PointCloud2& cloud);
  FrameReport advance(PreparedFrame prepared, std::uint64_t frame_index);
  // Compares the mesh with that of the frame before.
  void find_events(const VertexPlaces& before, const VertexComponents& components, FrameReport& report);

  FrameHandlerOptions options_;
  std::optional<Tracker> tracker_;
  std_msgs::Header header_;
  double seconds_ = 0.0;                  // Between the last frame and the one before; 0 if there is none.
  std::unique_ptr<VertexPlaces> before_;  // Of the frame before the last.
  std::uint64_t connectivity_ = 0;        // Of the last frame's mesh; 0 if there is none.
  std::vector<TopologyEvent> events_;     // Of the last frame.
  std::uint32_t topology_version_ = 0;
  std::unique_ptr<FrameAhead> ahead_;
  SurfaceSource surface_source_;
  bool records_cells_ = false;
};

}  // namespace particle_surface_tracker
