#pragma once

#include <vector>

#include <Eigen/Core>

#include "boundary.h"
#include "neighborhoods.h"
#include "wall_profile.h"

namespace particle_surface_tracker::simulator {

/// What the particles see around them at the beginning of a substep; the solvers keep it while they iterate.
struct Surroundings {
  explicit Surroundings(double spacing);

  /// Looks around at sorted positions: the grid has the same particles in the same order.
  void survey(const ParticleGrid& grid, const std::vector<Vec3d>& positions, const Boundary& boundary);

  std::size_t size() const { return density.size(); }

  /// True for particles that see a wall.
  bool is_near_wall(std::size_t particle) const { return !wall_gradient[particle].isZero(0.0F); }

  Neighborhoods neighborhoods;
  WallProfile wall_profile;
  double wall_depth;                       ///< How far behind the walls the liquid that stands for them begins [m].
  std::vector<float> density;              ///< Relative to the rest density, walls included.
  std::vector<Vec3f> wall_gradient;        ///< Of the walls' share of it [1/m].
  std::vector<Eigen::Matrix3f> wall_drag;  ///< Of walls that hold the liquid fully, per viscosity [1/m²].
};

}  // namespace particle_surface_tracker::simulator
