#include "fluid_simulator.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker::simulator {
namespace {

constexpr int kMostSubsteps = 1000;
constexpr double kHighestStartDensity = 1.5;
constexpr double kClearanceAllowance = 0.01;  // A start rounded to float may be this much too near [r].

SimulatorParameters checked(const SimulatorParameters& parameters) {
  check_simulator_parameters(parameters);
  return parameters;
}

template <class T>
void reorder(std::vector<T>& values, const std::vector<std::uint32_t>& order) {
  std::vector<T> sorted(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = values[order[i]];
  values = std::move(sorted);
}

std::vector<Vec3f> to_float(const std::vector<Vec3d>& values) {
  std::vector<Vec3f> result(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) result[i] = values[i].cast<float>();
  return result;
}

}  // namespace

FluidSimulator::FluidSimulator(const SimulatorParameters& parameters, const ParticleFrame& start)
    : parameters_(checked(parameters)),
      boundary_(parameters),
      surroundings_(parameters.spacing),
      pressure_(parameters.density_tolerance),
      viscosity_(parameters.viscosity, parameters.wall_friction),
      first_stamp_ns_(start.stamp_ns),
      frame_(make_particle_frame(start.stamp_ns, start.positions, start.ids, start.velocities)) {
  if (frame_.empty()) throw ParticleError("there are no particles to simulate");
  if (frame_.velocities.empty()) frame_.velocities.assign(frame_.size(), Vec3f::Zero());
  for (const Vec3f& position : frame_.positions) positions_.push_back(position.cast<double>());
  velocities_ = frame_.velocities;
  multipliers_.assign(frame_.size(), 0.0F);
  places_.resize(frame_.size());
  std::iota(places_.begin(), places_.end(), 0U);
  check_start();
  report_.fastest = fastest();
}

void FluidSimulator::check_start() {
  const double smallest = boundary_.smallest_clearance() - kClearanceAllowance * parameters_.spacing;
  const auto is_too_near = [&](const Vec3d& position) { return boundary_.clearance(position) < smallest; };
  const auto too_near = std::count_if(positions_.begin(), positions_.end(), is_too_near);
  if (too_near > 0) {
    const auto first = std::find_if(positions_.begin(), positions_.end(), is_too_near);
    throw ParticleError(fmt::format(
        "{} of {} particles start nearer than r/2 to the floor, a wall or an obstacle, or behind it; the "
        "first is id {} at ({}, {}, {}) m",
        too_near, positions_.size(), frame_.ids[first - positions_.begin()], first->x(), first->y(), first->z()));
  }
  sort_particles();
  const float densest = *std::max_element(surroundings_.density.begin(), surroundings_.density.end());
  if (densest > kHighestStartDensity) {
    throw ParticleError(
        fmt::format("the particles start at up to {:.3g} times the density that a spacing of {} m means; their "
                    "spacing seems to be {:.3g} m",
                    densest, parameters_.spacing, estimate_particle_spacing(frame_)));
  }
}

// Sorts the particles by the cells of the grid, so that neighbours are near in memory, and looks around.
void FluidSimulator::sort_particles() {
  const double cell_size = surroundings_.neighborhoods.kernel().radius();
  const ParticleGrid grid(to_float(positions_), cell_size);
  reorder(places_, grid.index());
  reorder(positions_, grid.index());
  reorder(velocities_, grid.index());
  reorder(multipliers_, grid.index());
  surroundings_.survey(grid, positions_, boundary_);
}

double FluidSimulator::fastest() const {
  float squared = 0.0F;
  for (const Vec3f& velocity : velocities_) squared = std::max(squared, velocity.squaredNorm());
  return std::sqrt(double{squared});
}

// √(p/ρ) where the pressure is highest: with longer substeps than it allows, liquid under pressure trembles.
double FluidSimulator::pressure_speed() const {
  if (previous_duration_ == 0.0) return 0.0;
  const float highest = *std::max_element(multipliers_.begin(), multipliers_.end());
  return std::sqrt(double{highest}) / previous_duration_;
}

// The Courant–Friedrichs–Lewy condition: t with v t + g t² = cfl · r.
double FluidSimulator::longest_substep() const {
  const double v = std::max(fastest(), pressure_speed());
  const double reach = parameters_.cfl * parameters_.spacing;
  const double divisor = v + std::sqrt(v * v + 4.0 * parameters_.gravity * reach);
  return divisor > 0.0 ? 2.0 * reach / divisor : parameters_.frame_interval;
}

const ParticleFrame& FluidSimulator::step() {
  report_ = {};
  double remaining = parameters_.frame_interval;
  while (remaining > 0.0) {
    const double substeps = std::max(1.0, std::ceil(remaining / longest_substep()));
    // Negated, so that a NaN fails it too.
    if (!(report_.substeps + substeps <= kMostSubsteps)) {
      throw ParticleError(fmt::format("particles move at up to {} m/s; the next frame would take more than {} substeps",
                                      fastest(), kMostSubsteps));
    }
    const double duration = remaining / substeps;
    advance(duration);
    remaining = substeps > 1.0 ? remaining - duration : 0.0;
  }
  report_.fastest = fastest();
  write_frame();
  return frame_;
}

void FluidSimulator::advance(double duration) {
  sort_particles();
  const float densest = *std::max_element(surroundings_.density.begin(), surroundings_.density.end());
  report_.densest = std::max(report_.densest, double{densest});

  // Velocities belong to the middles of substeps, which makes free fall exact (leapfrog).
  const Vec3f kick(0.0F, 0.0F, static_cast<float>(-0.5 * parameters_.gravity * (previous_duration_ + duration)));
  for (Vec3f& velocity : velocities_) velocity += kick;
  report_.viscosity_iterations += viscosity_.solve(surroundings_, duration, velocities_);

  const auto time = static_cast<float>(duration);
  displacements_.resize(velocities_.size());
  for_each_particle(velocities_.size(), [&](std::size_t i) { displacements_[i] = time * velocities_[i]; });
  const double ratio = previous_duration_ > 0.0 ? duration / previous_duration_ : 0.0;
  for (float& multiplier : multipliers_) multiplier *= static_cast<float>(ratio * ratio);
  const PressureReport solved = pressure_.solve(surroundings_, boundary_, positions_, multipliers_, displacements_);
  report_.pressure_iterations += solved.iterations;
  report_.density_error = std::max(report_.density_error, solved.error);

  for_each_particle(velocities_.size(), [&](std::size_t i) {
    // Again, for those few that the pressure has thrown at a wall from afar.
    displacements_[i] = boundary_.confine(positions_[i], displacements_[i]);
    velocities_[i] = displacements_[i] / time;
    positions_[i] += displacements_[i].cast<double>();
  });
  previous_duration_ = duration;
  ++report_.substeps;
}

void FluidSimulator::write_frame() {
  ++frames_;
  frame_.stamp_ns = first_stamp_ns_ + std::llround(static_cast<double>(frames_) * parameters_.frame_interval * 1e9);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    frame_.positions[places_[i]] = positions_[i].cast<float>();
    frame_.velocities[places_[i]] = velocities_[i];
  }
}

}  // namespace particle_surface_tracker::simulator
