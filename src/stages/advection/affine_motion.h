#pragma once

#include <algorithm>
#include <array>

#include <Eigen/Core>

#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// Weighted sums over the particles around a vertex. d is the offset from the vertex to a particle, u the displacement
/// of the particle minus `reference`, which is one of theirs: so single precision carries what differs between them,
/// and where nothing differs all sums of u are exactly 0.
struct MotionSums {
  static constexpr int offset = 1;         ///< Where Σ w d begins in `values`; Σ w stands before it.
  static constexpr int covariance = 4;     ///< Σ w d dᵀ: xx, xy, xz, yy, yz, zz.
  static constexpr int displacement = 10;  ///< Σ w u.
  static constexpr int cross = 13;         ///< Σ w u dᵀ, row by row.
  static constexpr int squared = 22;       ///< Σ w |u|².
  static constexpr int size = 23;

  std::array<float, size> values{};
  Vec3f reference = Vec3f::Zero();  ///< [m]
  int neighbors = 0;                ///< Particles with a weight.

  float weight() const { return values[0]; }
};

/// The weighted average of the displacements (Sec. 4) [m]. The weight must not be 0.
Vec3d average_displacement(const MotionSums& sums);

/// The displacement of a vertex by a first-order fit, and how far it is to be trusted.
struct AffineFit {
  Vec3d displacement = Vec3d::Zero();  ///< [m]
  double trust = 0.0;                  ///< 1 where the particles move as one body, 0 where they do not.
  double unrigidness = 0.0;            ///< How far the motion is from a rigid one (root mean square) [m].
  int rank = 0;                        ///< In how many directions the particles spread by more than the rank threshold.
};

/// Fits u(d) ≈ ū + A (d − d̄), bounded as docs/advection.md explains. Any sums at all: most vertices need only the
/// plain case, for which motion_kernel.h is faster.
/// \param r particle spacing [m].
AffineFit fit_affine_motion(const MotionSums& sums, double r, const Parameters& parameters);

/// True if the particles spread in all directions by more than the rank threshold, or all rest: a fit to more of them
/// would tell no more.
bool is_motion_settled(const MotionSums& sums, double r, const Parameters& parameters);

/// How much the unexplained variance of a fit counts by the number of particles that settle it: with as few particles
/// as unknowns any motion fits.
inline double settling_factor(int neighbors) {
  constexpr double unknowns = 4.0;       // Numbers that the fit takes from the neighbours, per component of u.
  constexpr double least_freedom = 0.1;  // With as few neighbours as unknowns any motion fits.
  return neighbors / std::max(neighbors - unknowns, least_freedom);
}

/// 1 where the misfit of a fit (root mean square [m]) is below affine_max_residual, 0 from twice that on.
inline double trust_in_fit(double misfit, double r, const Parameters& parameters) {
  return std::min(1.0, std::max(0.0, 2.0 - misfit / (parameters.affine_max_residual * r)));
}

}  // namespace particle_surface_tracker
