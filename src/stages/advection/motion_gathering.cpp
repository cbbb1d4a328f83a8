#include "motion_gathering.h"

namespace particle_surface_tracker {

namespace {

/// Wider by more than what rounding can put on the wrong side [radii].
constexpr double kSlack = 1e-5;

GroupBox make_box(const Vec3f& origin, const Vec3f& lower, const Vec3f& upper, double radius) {
  return {{origin.x(), origin.y(), origin.z()},
          {lower.x(), lower.y(), lower.z()},
          {upper.x(), upper.y(), upper.z()},
          static_cast<float>(radius * radius * (1.0 + kSlack))};
}

}  // namespace

SortedMotion::SortedMotion(const ParticleMotion& motion, const ParticleGrid& grid) : particles_(motion), grid_(grid) {
  for (int axis = 0; axis < 3; ++axis) {
    displacements_[axis].reserve(grid.size());
    for (const std::uint32_t particle : grid.index()) {
      displacements_[axis].push_back(motion.displacements[particle][axis]);
    }
  }
}

MotionArrays SortedMotion::arrays() const {
  return {{grid_.x().data(), grid_.y().data(), grid_.z().data()},
          {displacements_[0].data(), displacements_[1].data(), displacements_[2].data()},
          grid_.size()};
}

void Neighborhood::gather(const SortedMotion& motion, const MotionKernel& kernel, const Vec3f& origin,
                          const Vec3f& lower, const Vec3f& upper, double radius) {
  const ParticleGrid& grid = motion.grid();
  const MotionArrays arrays = motion.arrays();
  const GroupBox box = make_box(origin, lower, upper, radius);
  const Vec3d extent = Vec3d::Constant(radius * (1.0 + kSlack));
  const LatticeCoord first = grid.cell_of((origin + lower).cast<double>() - extent);
  const LatticeCoord last = grid.cell_of((origin + upper).cast<double>() + extent);
  count_ = 0;
  grid.for_each_long_range(first, last, [&](std::uint32_t begin, std::uint32_t end) {
    reserve(end - begin);
    count_ = kernel.gather(arrays, begin, end, box, near(), count_);
  });
}

void Neighborhood::gather(const Neighborhood& larger, const MotionKernel& kernel, const Vec3f& origin,
                          const Vec3f& lower, const Vec3f& upper, double radius) {
  count_ = 0;
  reserve(larger.count_);
  count_ = kernel.gather(larger.arrays(), 0, larger.count_, make_box(origin, lower, upper, radius), near(), 0);
  if (count_ == 0) return;
  const std::array<float, 3> reference = {numbers_[3][0], numbers_[4][0], numbers_[5][0]};
  reference_ = {reference[0], reference[1], reference[2]};
  kernel.refer(reference, near(), count_);
}

void Neighborhood::reserve(std::size_t more) {
  const std::size_t room = count_ + more + MotionBatch::lanes;
  if (numbers_.back().size() >= room) return;
  for (std::vector<float>& numbers : numbers_) numbers.resize(2 * room);
}

NearParticles Neighborhood::near() {
  const auto number = [&](int n) { return numbers_[n].data(); };
  return {{number(0), number(1), number(2)}, {number(3), number(4), number(5)}, number(6)};
}

MotionArrays Neighborhood::arrays() const {
  const auto number = [&](int n) { return numbers_[n].data(); };
  return {{number(0), number(1), number(2)}, {number(3), number(4), number(5)}, numbers_.front().size()};
}

void Neighborhood::sum(const MotionKernel& kernel, double radius, MotionBatch& batch) {
  if (weights_.size() < count_ * kWeightNumbers) weights_.resize(2 * count_ * kWeightNumbers);
  const auto inverse_squared_radius = static_cast<float>(1.0 / (radius * radius));
  kernel.sum(near(), count_, inverse_squared_radius, weights_.data(), batch);
}

MotionSums Neighborhood::sums_of(const MotionBatch& batch, int lane) const {
  MotionSums sums;
  for (int k = 0; k < MotionSums::size; ++k) sums.values[k] = batch.sums[k][lane];
  sums.reference = reference_;
  sums.neighbors = batch.neighbors[lane];
  return sums;
}

}  // namespace particle_surface_tracker
