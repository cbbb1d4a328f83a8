#include "viscosity_solver.h"

#include <cmath>

namespace particle_surface_tracker::simulator {
namespace {

constexpr int kMostIterations = 200;

// The residual ends below this part of what viscosity changes, or of the velocities themselves.
constexpr double kTolerance = 1e-2;
constexpr double kSmallestChange = 1e-6;

double dot(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
  return sum_over_particles(a.size(), [&](std::size_t i) { return double{a[i].dot(b[i])}; });
}

}  // namespace

// dragged_ = strength · L velocities.
void ViscositySolver::drag(const Surroundings& surroundings, float strength, const std::vector<Vec3f>& velocities) {
  const auto of_walls = static_cast<float>(wall_friction_);
  for_each_particle(surroundings.size(), [&](std::size_t i) {
    const Vec3f& own = velocities[i];
    Vec3f sum = of_walls * (surroundings.wall_drag[i] * own);
    for (const Neighbor& neighbor : surroundings.neighborhoods.of(i)) {
      sum += neighbor.drag * neighbor.offset.dot(own - velocities[neighbor.index]) * neighbor.offset;
    }
    dragged_[i] = strength * sum;
  });
}

int ViscositySolver::solve(const Surroundings& surroundings, double duration, std::vector<Vec3f>& velocities) {
  const auto strength = static_cast<float>(viscosity_ * duration);
  const std::size_t count = velocities.size();
  if (strength == 0.0F) return 0;
  residual_.resize(count);
  dragged_.resize(count);

  drag(surroundings, strength, velocities);
  for_each_particle(count, [&](std::size_t i) { residual_[i] = -dragged_[i]; });
  direction_ = residual_;
  double squared = dot(residual_, residual_);
  const double change = kTolerance * kTolerance * squared;
  const double negligible = kSmallestChange * kSmallestChange * dot(velocities, velocities);

  int iterations = 0;
  for (; squared > change && squared > negligible && iterations < kMostIterations; ++iterations) {
    drag(surroundings, strength, direction_);
    for_each_particle(count, [&](std::size_t i) { dragged_[i] += direction_[i]; });
    const auto length = static_cast<float>(squared / dot(direction_, dragged_));
    for_each_particle(count, [&](std::size_t i) {
      velocities[i] += length * direction_[i];
      residual_[i] -= length * dragged_[i];
    });
    const double before = squared;
    squared = dot(residual_, residual_);
    const auto kept = static_cast<float>(squared / before);
    for_each_particle(count, [&](std::size_t i) { direction_[i] = residual_[i] + kept * direction_[i]; });
  }
  return iterations;
}

}  // namespace particle_surface_tracker::simulator
