#pragma once

#include <cstdint>
#include <memory>

#include "particle_surface_tracker/core/frame_report.h"
#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/particle_frame.h"
#include "particle_surface_tracker/core/topology_cells.h"
#include "particle_surface_tracker/core/triangle_mesh.h"
#include "particle_surface_tracker/stages/detection.h"
#include "particle_surface_tracker/tracker/tracker_state.h"

namespace particle_surface_tracker {

/// Carries one explicit mesh through the frames of a particle simulation: the only object with state across frames.
///
/// Not for use by several threads at once; the stages inside run in parallel. Whatever throws leaves the tracker as it
/// was, so that the next good frame goes on from the last good one.
class Tracker {
 public:
  /// \throw ParameterError as check_parameters().
  explicit Tracker(const Parameters& parameters);

  /// Goes on from where another tracker was: every frame from here on is what it would have been there, byte for byte.
  /// \throw ParameterError, ParticleError, MeshError, TrackingError as check_tracker_state().
  explicit Tracker(const TrackerState& state);
  ~Tracker();
  Tracker(Tracker&&) noexcept;
  Tracker& operator=(Tracker&&) noexcept;

  /// Begins with the mesh that bounds the liquid of `frame`, and measures δ of its vertices (Sec. 5.2, t = 0). What was
  /// tracked before is forgotten.
  /// \throw ParticleError if the frame is empty.
  /// \throw TrackingError if mesh and particles do not belong together (check_mesh_fits_particles()).
  FrameReport start(const TriangleMesh& mesh, const ParticleFrame& frame, std::uint64_t frame_index = 0);

  /// Begins with the implicit surface of `frame` itself as the mesh.
  /// \throw ParticleError if the frame is empty.
  /// \throw TrackingError if the spacing is not theirs (check_spacing_fits_particles()), or they have no surface at it.
  FrameReport start_from_particles(const ParticleFrame& frame, std::uint64_t frame_index = 0);

  bool started() const;

  /// Carries the mesh to the next frame: advection, projection, detection (Secs. 4 to 5.3).
  ///
  /// A frame without particles, or with none in common with the one before, moves nothing and says so in the report;
  /// the mesh waits for particles to return.
  /// \throw TrackingError if start() has not been called.
  FrameReport advance(const ParticleFrame& frame, std::uint64_t frame_index);

  /// As above, with the implicit surface made before, by make_implicit_surface() from the same particles and
  /// parameters: the result is the same.
  /// \param surface null: it is made here. Not looked at where the frame holds no particles.
  /// \throw TrackingError if start() has not been called, or the surface has other cells than this tracker wants.
  FrameReport advance(const ParticleFrame& frame, std::uint64_t frame_index,
                      std::shared_ptr<const ImplicitSurface> surface);

  /// Everything that another tracker needs to go on from here.
  /// \throw TrackingError if start() has not been called.
  TrackerState state() const;

  const Parameters& parameters() const;

  /// Changes parameters between frames.
  /// \throw ParameterError if one is invalid, or one that needs a reset differs while a mesh is being tracked.
  void set_parameters(const Parameters& parameters);

  /// The mesh of the last frame.
  const TriangleMesh& mesh() const;

  /// The implicit surface of the last frame, or null before the first.
  std::shared_ptr<const ImplicitSurface> implicit_surface() const;

  /// What was flagged in the last frame.
  const Detection& detection() const;

  /// From the next frame on, keeps the cells of Γ that topology matching and re-meshing looked at. Meshes do not depend
  /// on it.
  void record_topology_cells(bool on);

  /// Those of the last frame; empty where nothing was flagged, deep or tangled. Null: they were not recorded.
  std::shared_ptr<const TopologyCells> topology_cells() const;

 private:
  void require_started() const;

  struct State;
  std::unique_ptr<State> state_;
};

/// Checks that a spacing is that of these particles. Fewer than ten have none.
/// \throw TrackingError, with both, if it is more than three times the median distance from a particle to the nearest
/// other one, or less than a third of it.
void check_spacing_fits_particles(const ParticleFrame& frame, double particle_spacing);

/// Checks that a mesh bounds the liquid of these particles.
/// \throw TrackingError as check_spacing_fits_particles(), and, with the figures, if more than 5 % of the particles lie
/// outside the mesh by more than r, or the median distance from the vertices to the nearest particle is above 3 r
/// (wrong scale, axes or offset).
void check_mesh_fits_particles(const TriangleMesh& mesh, const ParticleFrame& frame, double particle_spacing);

}  // namespace particle_surface_tracker
