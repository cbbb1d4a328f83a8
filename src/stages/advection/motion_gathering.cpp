#include "motion_gathering.h"

#include <array>

namespace particle_surface_tracker {

namespace {

/// Wider by more than what rounding can put on the wrong side [radii].
constexpr double kSlack = 1e-5;

}  // namespace

SortedMotion::SortedMotion(const ParticleMotion& motion, const ParticleGrid& grid) : particles_(motion), grid_(grid) {
  displacements_.reserve(grid.size());
  for (const std::uint32_t particle : grid.index()) displacements_.push_back(motion.displacements[particle]);
}

void Neighborhood::gather(const SortedMotion& motion, const Vec3f& origin, const GroupBox& box, double radius) {
  const ParticleGrid& grid = motion.grid();
  const std::array<const float*, 3> coordinates = {grid.x().data(), grid.y().data(), grid.z().data()};
  const auto squared_reach = static_cast<float>(radius * radius * (1.0 + kSlack));
  const Vec3d extent = Vec3d::Constant(radius * (1.0 + kSlack));
  const LatticeCoord lower = grid.cell_of((origin + box.lower).cast<double>() - extent);
  const LatticeCoord upper = grid.cell_of((origin + box.upper).cast<double>() + extent);
  bool has_reference = false;
  count_ = 0;
  grid.for_each_long_range(lower, upper, [&](std::uint32_t begin, std::uint32_t end) {
    if (!has_reference) {
      reference_ = motion.displacement(begin);
      has_reference = true;
    }
    const Eigen::Index size = end - begin;
    if (squared_beyond_.size() < size) squared_beyond_.resize(2 * size);
    const auto squared_beyond = [&](int axis) {
      const auto place = Eigen::Map<const Eigen::ArrayXf>(coordinates[axis] + begin, size) - origin[axis];
      return (box.lower[axis] - place).max(place - box.upper[axis]).max(0.0f).square();
    };
    squared_beyond_.head(size) = squared_beyond(0) + squared_beyond(1) + squared_beyond(2);
    if (particles_.size() < count_ + size) particles_.resize(2 * (count_ + size));
    for (Eigen::Index n = 0; n < size; ++n) {
      if (squared_beyond_[n] >= squared_reach) continue;
      NearParticle& p = particles_[count_++];
      for (int axis = 0; axis < 3; ++axis) p.position[axis] = coordinates[axis][begin + n] - origin[axis];
      const Vec3f u = motion.displacement(begin + n) - reference_;
      p.displacement = {u.x(), u.y(), u.z()};
      p.squared_displacement = u.squaredNorm();
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
