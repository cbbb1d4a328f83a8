#include "pressure_solver.h"

#include <algorithm>
#include <cmath>

namespace particle_surface_tracker::simulator {
namespace {

constexpr int kFewestIterations = 2;
constexpr int kMostIterations = 100;
constexpr double kNegligibleError = 1e-5;  // Rounding: liquid in free fall needs no iteration.
constexpr float kDamping = 0.5F;
constexpr float kUndonePerSubstep = 0.1F;  // Of an excess that is there already.

// A particle with hardly a neighbour has hardly a gradient; its multiplier must not become huge [1/h²].
constexpr double kSmallestWeight = 1e-2;

}  // namespace

// The steps: what a particle's own multiplier does to its own density.
void PressureSolver::weigh(const Surroundings& surroundings) {
  const double radius = surroundings.neighborhoods.kernel().radius();
  const auto smallest = static_cast<float>(kSmallestWeight / (radius * radius));
  step_.resize(surroundings.size());
  for_each_particle(surroundings.size(), [&](std::size_t i) {
    Vec3f sum = surroundings.wall_gradient[i];
    float squares = 0.0F;
    for (const Neighbor& neighbor : surroundings.neighborhoods.of(i)) {
      const Vec3f gradient = neighbor.slope * neighbor.offset;
      sum += gradient;
      squares += gradient.squaredNorm();
    }
    step_[i] = kDamping / std::max(smallest, sum.squaredNorm() + squares);
  });
}

void PressureSolver::push(const Surroundings& surroundings, const std::vector<float>& multipliers,
                          const std::vector<Vec3f>& displacements) {
  for_each_particle(surroundings.size(), [&](std::size_t i) {
    const float own = multipliers[i];
    Vec3f push = own * surroundings.wall_gradient[i];
    for (const Neighbor& neighbor : surroundings.neighborhoods.of(i)) {
      push += (own + multipliers[neighbor.index]) * neighbor.slope * neighbor.offset;
    }
    pushed_[i] = displacements[i] - push;
  });
}

// Walls stop particles while the solver iterates, so that it knows of what they hold back.
void PressureSolver::confine(const Surroundings& surroundings, const Boundary& boundary,
                             const std::vector<Vec3d>& positions) {
  for_each_particle(surroundings.size(), [&](std::size_t i) {
    if (surroundings.is_near_wall(i)) pushed_[i] = boundary.confine(positions[i], pushed_[i]);
  });
}

// The mean error over the particles that have pressure or should have.
double PressureSolver::measure(const Surroundings& surroundings, const std::vector<float>& multipliers) {
  for_each_particle(surroundings.size(), [&](std::size_t i) {
    float change = pushed_[i].dot(surroundings.wall_gradient[i]);
    for (const Neighbor& neighbor : surroundings.neighborhoods.of(i)) {
      change += neighbor.slope * neighbor.offset.dot(pushed_[i] - pushed_[neighbor.index]);
    }
    const float before = surroundings.density[i] - 1.0F;
    excess_[i] = change + (before > 0.0F ? kUndonePerSubstep * before : before);
  });
  const auto is_pressed = [&](std::size_t i) { return multipliers[i] > 0.0F || excess_[i] > 0.0F; };
  const double errors = sum_over_particles(
      surroundings.size(), [&](std::size_t i) { return is_pressed(i) ? std::abs(double{excess_[i]}) : 0.0; });
  const double pressed =
      sum_over_particles(surroundings.size(), [&](std::size_t i) { return is_pressed(i) ? 1.0 : 0.0; });
  return errors / std::max(1.0, pressed);
}

PressureReport PressureSolver::solve(const Surroundings& surroundings, const Boundary& boundary,
                                     const std::vector<Vec3d>& positions, std::vector<float>& multipliers,
                                     std::vector<Vec3f>& displacements) {
  weigh(surroundings);
  pushed_.resize(surroundings.size());
  excess_.resize(surroundings.size());
  PressureReport report;
  while (true) {
    push(surroundings, multipliers, displacements);
    confine(surroundings, boundary, positions);
    report.error = measure(surroundings, multipliers);
    if (report.error <= kNegligibleError || report.iterations == kMostIterations) break;
    if (report.error <= tolerance_ && report.iterations >= kFewestIterations) break;
    for_each_particle(surroundings.size(),
                      [&](std::size_t i) { multipliers[i] = std::max(0.0F, multipliers[i] + step_[i] * excess_[i]); });
    ++report.iterations;
  }
  displacements.swap(pushed_);
  return report;
}

}  // namespace particle_surface_tracker::simulator
