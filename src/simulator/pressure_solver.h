#pragma once

#include <vector>

#include "surroundings.h"

namespace particle_surface_tracker::simulator {

struct PressureReport {
  int iterations = 0;
  double error = 0.0;  ///< Mean over the particles under pressure, relative to the rest density.
};

/// Changes displacements so that liquid does not become denser than at rest, nor enters walls: the constant-density
/// solver of DFSPH (Bender and Koschier 2015), written for the displacements u in one substep as position-based fluids
/// are (Macklin and Müller 2013).
///
/// With gradients taken at the beginning of the substep and densities relative to that at rest, the multipliers κ ≥ 0
/// (pressure times time squared over density) solve
///
///     Σ_j (u_i − u_j)·∇W_ij + u_i·∇ρ_wall ≤ 1 − ρ_i,   u_i ← u_i − Σ_j (κ_i + κ_j) ∇W_ij − κ_i ∇ρ_wall
///
/// with equality wherever κ > 0, by damped Jacobi steps. The pushes between two particles are equal and opposite.
/// Where ρ_i > 1 already, only a part of the excess is undone in one substep: undone at once it would become speed.
class PressureSolver {
 public:
  /// \param tolerance of the mean error, relative to the rest density.
  explicit PressureSolver(double tolerance) : tolerance_(tolerance) {}

  /// \param multipliers the solver's first guess, and its result [m²].
  /// \param displacements in the substep, without pressure and then with it [m].
  PressureReport solve(const Surroundings& surroundings, const Boundary& boundary, const std::vector<Vec3d>& positions,
                       std::vector<float>& multipliers, std::vector<Vec3f>& displacements);

 private:
  void weigh(const Surroundings& surroundings);
  void push(const Surroundings& surroundings, const std::vector<float>& multipliers,
            const std::vector<Vec3f>& displacements);
  void confine(const Surroundings& surroundings, const Boundary& boundary, const std::vector<Vec3d>& positions);
  double measure(const Surroundings& surroundings, const std::vector<float>& multipliers);

  double tolerance_;
  std::vector<float> step_;    // Of a multiplier, per error of the density [m²].
  std::vector<Vec3f> pushed_;  // Displacements with pressure [m].
  std::vector<float> excess_;  // Of the density at the end of the substep, relative to the rest density.
};

}  // namespace particle_surface_tracker::simulator
