#pragma once

#include <cstddef>
#include <vector>

#include "field_stencil.h"
#include "particle_surface_tracker/core/signed_distance_field.h"
#include "particle_surface_tracker/core/types.h"
#include "particle_surface_tracker/stages/projection.h"
#include "tricubic_kernel.h"

namespace particle_surface_tracker {

/// What the search for φ = 0 found from one vertex.
struct SurfacePoint {
  ProjectionStatus status = ProjectionStatus::kNotFound;
  Vec3d position = Vec3d::Zero();  ///< x* [m]; x itself where no step was needed.
  Vec3d normal = Vec3d::Zero();    ///< ∇φ/|∇φ| at x*, outward.
  float start_value = 0.0f;        ///< φ(x) [m].
};

/// How a search ends.
struct SearchLimits {
  float epsilon;    ///< ε: part of the distance that a step travels.
  float tolerance;  ///< |φ| below this is found [m].
  int max_steps;
};

/// Moves vertices toward φ = 0 in steps of ε·φ along the gradient, with cubic interpolation, until |φ| is below the
/// tolerance (Sec. 5.2). Many at a time, each as if it were alone. One object per thread.
class SurfaceSearch {
 public:
  /// \param leaves of the field; must outlive this.
  SurfaceSearch(const SignedDistanceField& field, const FieldLeaves& leaves, const SearchLimits& limits);

  /// Finds x* for vertices [begin, end) of `vertices` and writes them to the same places of `found`.
  void find(const std::vector<Vec3f>& vertices, std::size_t begin, std::size_t end, std::vector<SurfacePoint>& found);

 private:
  struct Lane {
    std::size_t vertex = 0;
    openvdb::Coord cell;
    int steps = 0;
    bool busy = false;
  };

  /// Puts the next vertex into a lane, or leaves it idle when there are none left.
  void refill(int lane, const std::vector<Vec3f>& vertices, std::size_t& next, std::size_t end,
              std::vector<SurfacePoint>& found);

  /// Looks at what a step found.
  /// \return true if the lane has ended its search.
  bool settle(int lane, const std::vector<Vec3f>& vertices, SurfacePoint& found);

  /// Takes over the place after a step, in a new cell where it left the old one.
  void advance(int lane);

  FieldStencil stencil_;
  TricubicKernel kernel_;
  SearchLimits limits_;
  double dx_;
  float largest_;         // values and slopes beyond this come from an absent node [m]
  float smallest_slope_;  // [m per cell]
  std::array<Lane, TricubicBatch::lanes> lanes_;
  TricubicBatch batch_{};
};

}  // namespace particle_surface_tracker
