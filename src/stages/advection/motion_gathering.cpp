#include "motion_gathering.h"

namespace particle_surface_tracker {

namespace {

/// Wider by more than what rounding can put on the wrong side [radii].
constexpr double kSlack = 1e-5;

}  // namespace

SortedMotion::SortedMotion(const ParticleMotion& motion, const ParticleGrid& grid) : particles_(motion), grid_(grid) {
  displacements_.reserve(grid.size());
  for (const std::uint32_t particle : grid.index()) displacements_.push_back(motion.displacements[particle]);
}

void Neighborhood::gather(const SortedMotion& motion, const MotionKernel& kernel, const Vec3f& origin,
                          const Vec3f& lower, const Vec3f& upper, double radius) {
  const ParticleGrid& grid = motion.grid();
  const Coordinates coordinates = {{grid.x().data(), grid.y().data(), grid.z().data()}, grid.size()};
  const GroupBox box = {{origin.x(), origin.y(), origin.z()},
                        {lower.x(), lower.y(), lower.z()},
                        {upper.x(), upper.y(), upper.z()},
                        static_cast<float>(radius * radius * (1.0 + kSlack))};
  const Vec3d extent = Vec3d::Constant(radius * (1.0 + kSlack));
  const LatticeCoord first = grid.cell_of((origin + lower).cast<double>() - extent);
  const LatticeCoord last = grid.cell_of((origin + upper).cast<double>() + extent);
  bool has_reference = false;
  count_ = 0;
  grid.for_each_long_range(first, last, [&](std::uint32_t begin, std::uint32_t end) {
    if (!has_reference) {
      reference_ = motion.displacement(begin);
      has_reference = true;
    }
    if (near_.size() < count_ + end - begin) near_.resize(2 * (count_ + end - begin));
    count_ += kernel.select(coordinates, begin, end, box, near_.data() + count_);
  });
  if (particles_.size() < count_) particles_.resize(2 * count_);
  for (std::size_t n = 0; n < count_; ++n) {
    NearParticle& p = particles_[n];
    for (int axis = 0; axis < 3; ++axis) p.position[axis] = coordinates.axis[axis][near_[n]] - origin[axis];
    const Vec3f u = motion.displacement(near_[n]) - reference_;
    p.displacement = {u.x(), u.y(), u.z()};
    p.squared_displacement = u.squaredNorm();
  }
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
