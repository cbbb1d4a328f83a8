#pragma once

#include <vector>

#include "surroundings.h"

namespace particle_surface_tracker::simulator {

/// Lets viscosity act on the velocities for one substep, implicitly (Weiler et al. 2018), so that no viscosity is too
/// large for the substep: solves (1 + ν Δt L) v' = v with
///
///     (L v)_i = Σ_j 2 (d + 2) V |W'_ij| / s_ij³ · x_ij x_ijᵀ (v_i − v_j)  +  drag of the walls
///
/// by conjugate gradients. Without walls translations and rotations are in the null space of L, so that momentum and
/// angular momentum are conserved, whenever the iteration ends.
class ViscositySolver {
 public:
  /// \param viscosity ν [m²/s].
  /// \param wall_friction part of the full drag of the walls.
  ViscositySolver(double viscosity, double wall_friction) : viscosity_(viscosity), wall_friction_(wall_friction) {}

  /// \param duration of the substep [s].
  /// \param velocities before and after [m/s].
  /// \return the number of iterations.
  int solve(const Surroundings& surroundings, double duration, std::vector<Vec3f>& velocities);

 private:
  void drag(const Surroundings& surroundings, float strength, const std::vector<Vec3f>& velocities);

  double viscosity_;
  double wall_friction_;
  std::vector<Vec3f> residual_, direction_, dragged_;
};

}  // namespace particle_surface_tracker::simulator
