#pragma once

#include <memory>
#include <vector>

#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/core/signed_distance_field.h"
#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

class SurfaceCells;

/// Makes signed distance fields of one triangulated isosurface (Sec. 5.1), with as many nodes as are needed; what they
/// have in common is prepared once.
///
/// Distances are those to the closest triangle up to rounding, and in any case within 0.02 Δx_φ. Signs come from φ̃ at
/// the isosurface and are carried along lattice edges that it does not cross, so that air enclosed in the liquid is
/// outside. A node is in a field only as far as its distance is at most the reach and lattice edges between such nodes
/// lead there from the isosurface.
class DistanceFields {
 public:
  /// \param surface field and triangulation of the frame; must live as long as this.
  explicit DistanceFields(const ImplicitSurface& surface);
  ~DistanceFields();

  /// What the projection of vertices needs that are close to the isosurface: the 4 × 4 × 4 nodes around every cell that
  /// the isosurface passes through or that holds one of `positions`.
  /// \param positions [m].
  /// \param reach largest distance [m].
  SignedDistanceField at_stencils(const std::vector<Vec3f>& positions, double reach) const;

  /// What the projection of vertices some cells away needs: the nodes around the straight way from each of `positions`
  /// to the closest place on the isosurface, if that is within reach.
  /// \param positions [m].
  /// \param reach largest distance [m].
  SignedDistanceField on_ways(const std::vector<Vec3f>& positions, double reach) const;

  /// All there is around vertices at any distance: every node within max(reach, 4 Δx_φ) along each axis of one of
  /// `positions`.
  /// \param positions [m].
  /// \param reach largest distance [m].
  SignedDistanceField around(const std::vector<Vec3f>& positions, double reach) const;

  /// The cells of the isosurface, for others that ask for distances in the frame.
  const std::shared_ptr<const SurfaceCells>& cells() const { return cells_; }

  /// Every node of the band.
  /// \param reach largest distance [m].
  SignedDistanceField everywhere(double reach) const;

 private:
  const ImplicitSurface& surface_;
  std::shared_ptr<const SurfaceCells> cells_;
};

}  // namespace particle_surface_tracker
