#pragma once

#include <optional>
#include <vector>

#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/signed_distance_field.h"
#include "particle_surface_tracker/stages/distance_field.h"
#include "particle_surface_tracker/stages/projection.h"
#include "stage_timer.h"

namespace particle_surface_tracker {

/// φ of one frame, made as far as the vertices that are projected need it (Sec. 5.1: φ is computed locally), and kept
/// for those that come later in the frame.
class NarrowBand {
 public:
  /// All arguments must outlive this.
  NarrowBand(const ImplicitSurface& surface, const Parameters& parameters, StageTimer& timer);

  /// Projects vertices with as much of φ as they need: first only the nodes that cubic interpolation touches next to
  /// the isosurface and the vertices, or those that are there from the call before; then, for the vertices that this
  /// does not lead to the isosurface, their ways to it, then a band of theirs, and of twice the reach, and again, up to
  /// `max_reach`.
  /// \param delta δ of each vertex [m].
  /// \param reach first reach [m].
  /// \param max_reach last reach [m].
  Projection project(const std::vector<Vec3f>& vertices, const std::vector<float>& delta, double reach,
                     double max_reach);

  /// The cells of the isosurface.
  const std::shared_ptr<const SurfaceCells>& cells() const { return fields_.cells(); }

 private:
  const Parameters& parameters_;
  StageTimer& timer_;
  double stencil_reach_;
  DistanceFields fields_;
  std::optional<SignedDistanceField> stencils_;
};

}  // namespace particle_surface_tracker
