#include "long_step.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace particle_surface_tracker {

namespace {

constexpr double kMostSteps = 16.0;

/// Farthest that most particles move in one step [r].
constexpr double kStepLength = 4.0;

/// Share of the particles that may move farther: drops that fall fast do not make all others wait.
constexpr double kFastShare = 0.01;

/// The displacement that all but a few particles keep below [m].
double usual_displacement(const ParticleMotion& motion) {
  std::vector<float> squared;
  squared.reserve(motion.displacements.size());
  for (const Vec3f& displacement : motion.displacements) squared.push_back(displacement.squaredNorm());
  const auto fast = static_cast<std::ptrdiff_t>(kFastShare * static_cast<double>(squared.size()));
  const auto place = squared.begin() + fast;
  std::nth_element(squared.begin(), place, squared.end(), std::greater<>());
  return std::sqrt(static_cast<double>(*place));
}

}  // namespace

int steps_for(const ParticleMotion& motion, std::uint64_t elapsed, const Parameters& parameters) {
  if (motion.displacements.empty()) return 1;
  const double by_length = std::ceil(usual_displacement(motion) / (kStepLength * parameters.particle_spacing));
  return static_cast<int>(std::clamp(std::max(by_length, static_cast<double>(elapsed)), 1.0, kMostSteps));
}

std::vector<Vec3f> advect_in_steps(const std::vector<Vec3f>& vertices, const ParticleMotion& motion, int steps,
                                   const Parameters& parameters) {
  const double r = parameters.particle_spacing;
  if (steps <= 1) return advect(vertices, motion, ParticleGrid(motion.positions, r), parameters);
  ParticleMotion step = motion;
  const float part = 1.0f / static_cast<float>(steps);
  for (Vec3f& displacement : step.displacements) displacement *= part;
  std::vector<Vec3f> advected = vertices;
  for (int n = 0; n < steps; ++n) {
    // From the beginning, so that rounding does not add up.
    const float passed = static_cast<float>(n) * part;
    for (std::size_t i = 0; i < step.positions.size(); ++i) {
      step.positions[i] = motion.positions[i] + passed * motion.displacements[i];
    }
    advected = advect(advected, step, ParticleGrid(step.positions, r), parameters);
  }
  return advected;
}

}  // namespace particle_surface_tracker
