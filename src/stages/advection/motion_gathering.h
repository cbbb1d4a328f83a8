#pragma once

#include <cstdint>
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

  /// Of the sorted particle n [m].
  const Vec3f& displacement(std::size_t n) const { return displacements_[n]; }

 private:
  const ParticleMotion& particles_;
  const ParticleGrid& grid_;
  std::vector<Vec3f> displacements_;
};

/// The particles around a group of vertices, ready for the sums. One object per thread.
class Neighborhood {
 public:
  /// Takes the particles that are nearer than `radius` to a box, in the order of the grid.
  /// \param origin [m]; in single precision, so that places relative to it lose next to nothing however far they are
  /// from the origin of the world.
  /// \param lower, upper ends of the box, relative to the origin [m].
  void gather(const SortedMotion& motion, const MotionKernel& kernel, const Vec3f& origin, const Vec3f& lower,
              const Vec3f& upper, double radius);

  /// Sums over the particles for every lane of a batch (Sec. 4, poly6).
  void sum(const MotionKernel& kernel, double radius, MotionBatch& batch);

  /// The sums of one lane of a batch.
  MotionSums sums_of(const MotionBatch& batch, int lane) const;

  const Vec3f& reference() const { return reference_; }

 private:
  std::vector<std::uint32_t> near_;  // of the sorted particles
  std::vector<NearParticle> particles_;
  std::size_t count_ = 0;
  Vec3f reference_ = Vec3f::Zero();
  std::vector<float> weights_;
};

}  // namespace particle_surface_tracker
