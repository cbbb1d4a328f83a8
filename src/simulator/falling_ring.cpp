#include "falling_ring.h"

#include <utility>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "particle_surface_tracker/core/error.h"
#include "scaly_ring.h"

namespace particle_surface_tracker::simulator {
namespace {

constexpr double kSmallestSpacing = 0.01;   // Some 340,000 particles [m].
constexpr double kLargestSpacing = 0.075;   // Twice that is the gap between ball and floor [m].
const Vec3d kRingCenter(-0.08, 0.0, 1.05);  // [m]
constexpr double kTilt = -0.3;              // Around the y axis [rad].
const Sphere kBall{{0.45, 0.0, 0.4}, 0.25};

void place(std::vector<Vec3f>& positions) {
  const Eigen::AngleAxisd tilt(kTilt, Vec3d::UnitY());
  for (Vec3f& position : positions) position = (tilt * position.cast<double>() + kRingCenter).cast<float>();
}

}  // namespace

SimulatorParameters falling_ring_parameters() {
  SimulatorParameters parameters;
  parameters.spacing = 0.03;
  parameters.viscosity = 0.5;
  parameters.wall_friction = 0.02;
  parameters.tank_half_width = 0.95;
  return parameters;
}

Scene falling_ring(SimulatorParameters parameters) {
  // Negated, so that a NaN fails it too.
  if (!(parameters.spacing >= kSmallestSpacing && parameters.spacing <= kLargestSpacing)) {
    throw ParameterError(fmt::format("spacing is {} m; for the ring it must lie in [{}, {}]", parameters.spacing,
                                     kSmallestSpacing, kLargestSpacing));
  }
  const ScalyRing ring;
  Scene scene;
  scene.mesh = ring.mesh();
  scene.particles = ring.fill(scene.mesh, parameters.spacing);
  place(scene.mesh.positions());
  place(scene.particles.positions);
  scene.parameters = std::move(parameters);
  scene.parameters.obstacles.push_back(kBall);
  return scene;
}

}  // namespace particle_surface_tracker::simulator
