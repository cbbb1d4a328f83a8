#include "motion_gathering.h"

#include <algorithm>

namespace particle_surface_tracker {

namespace {

/// Wider by more than what rounding can put on the wrong side [radii].
constexpr double kSlack = 1e-5;

}  // namespace

SortedMotion::SortedMotion(const ParticleMotion& motion, const ParticleGrid& grid) : particles_(motion), grid_(grid) {
  displacements_.reserve(grid.size());
  for (const std::uint32_t particle : grid.index()) displacements_.push_back(motion.displacements[particle]);
}

void Neighborhood::gather(const SortedMotion& motion, const LatticeCoord& lower, const LatticeCoord& upper,
                          const Vec3d& origin, const GroupBox& box, double radius) {
  const ParticleGrid& grid = motion.grid();
  const float* const coordinates[] = {grid.x().data(), grid.y().data(), grid.z().data()};
  const auto squared_reach = static_cast<float>(radius * radius * (1.0 + kSlack));
  bool has_reference = false;
  count_ = 0;
  grid.for_each_range(lower, upper, [&](std::uint32_t begin, std::uint32_t end) {
    if (!has_reference) {
      reference_ = motion.displacement(begin);
      has_reference = true;
    }
    // One more place than particles: each is written before it is known whether it stays.
    if (particles_.size() < count_ + (end - begin) + 1) particles_.resize(2 * (count_ + (end - begin)) + 1);
    for (std::uint32_t n = begin; n < end; ++n) {
      NearParticle& p = particles_[count_];
      float squared_distance = 0.0f;
      for (int axis = 0; axis < 3; ++axis) {
        p.position[axis] = static_cast<float>(coordinates[axis][n] - origin[axis]);
        const float beyond =
            std::max(std::max(box.lower[axis] - p.position[axis], p.position[axis] - box.upper[axis]), 0.0f);
        squared_distance += beyond * beyond;
      }
      const Vec3f u = motion.displacement(n) - reference_;
      p.displacement = {u.x(), u.y(), u.z()};
      p.squared_displacement = u.squaredNorm();
      count_ += squared_distance < squared_reach ? 1 : 0;
    }
  });
}

void Neighborhood::sum(const MotionKernel& kernel, double radius, MotionBatch& batch) {
  if (weights_.size() < count_ * MotionBatch::lanes) weights_.resize(2 * count_ * MotionBatch::lanes);
  const auto inverse_squared_radius = static_cast<float>(1.0 / (radius * radius));
  kernel.sum(particles_.data(), count_, inverse_squared_radius, weights_.data(), batch);
}

MotionSums Neighborhood::sums_of(const MotionBatch& batch, int lane) const {
  MotionSums sums;
  for (int k = 0; k < MotionSums::size; ++k) sums.values[k] = batch.sums[k][lane];
  sums.reference = reference_;
  sums.neighbors = batch.neighbors[lane];
  return sums;
}

}  // namespace particle_surface_tracker
