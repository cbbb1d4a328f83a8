#pragma once

#include <array>
#include <vector>

#include "motion_kernel.h"
#include "particle_surface_tracker/core/particle_grid.h"
#include "particle_surface_tracker/stages/advection.h"

namespace particle_surface_tracker {

/// Particles with their displacements, sorted into the cells of a grid.
class SortedMotion {
 public:
  /// \param grid of the positions of `motion`; both must outlive this.
  SortedMotion(const ParticleMotion& motion, const ParticleGrid& grid);

  const ParticleMotion& particles() const { return particles_; }
  const ParticleGrid& grid() const { return grid_; }

  /// Positions and displacements in the order of the grid.
  MotionArrays arrays() const;

  /// Of the sorted particle n [m].
  Vec3f displacement(std::size_t n) const { return {displacements_[0][n], displacements_[1][n], displacements_[2][n]}; }

 private:
  const ParticleMotion& particles_;
  const ParticleGrid& grid_;
  std::array<std::vector<float>, 3> displacements_;
};

/// The particles around some vertices. One object per thread.
class Neighborhood {
 public:
  /// Takes the particles that are nearer than `radius` to a box, in the order of the grid.
  /// \param origin [m]; in single precision, so that places relative to it lose next to nothing however far they are
  /// from the origin of the world.
  /// \param lower, upper ends of the box, relative to the origin [m].
  void gather(const SortedMotion& motion, const MotionKernel& kernel, const Vec3f& origin, const Vec3f& lower,
              const Vec3f& upper, double radius);

  /// Takes them from a larger neighbourhood that holds all of them, and makes them ready for sum().
  /// \param origin relative to that of the larger one [m].
  void gather(const Neighborhood& larger, const MotionKernel& kernel, const Vec3f& origin, const Vec3f& lower,
              const Vec3f& upper, double radius);

  /// Sums over the particles for every lane of a batch (Sec. 4, poly6).
  void sum(const MotionKernel& kernel, double radius, MotionBatch& batch);

  /// The sums of one lane of a batch.
  MotionSums sums_of(const MotionBatch& batch, int lane) const;

  /// What the displacements in the sums are relative to: that of one of the particles, so that they are 0 where all
  /// move alike.
  const Vec3f& reference() const { return reference_; }

 private:
  /// Makes room for as many particles more, and for what the kernel writes beyond the end.
  void reserve(std::size_t more);
  NearParticles near();
  MotionArrays arrays() const;

  std::array<std::vector<float>, 7> numbers_;  // positions, displacements, squared displacements
  std::size_t count_ = 0;
  Vec3f reference_ = Vec3f::Zero();
  std::vector<float> weights_;
};

}  // namespace particle_surface_tracker
