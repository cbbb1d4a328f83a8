#include "simulator_parameters.h"

#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker::simulator {
namespace {

constexpr double kTiny = std::numeric_limits<double>::min();
constexpr double kSmallestGap = 2.0;             // Around obstacles [r].
constexpr double kSmallestObstacleRadius = 2.0;  // [r]

SimulatorParameter real(double SimulatorParameters::*field, std::string name, std::string symbol, std::string unit,
                        double minimum, double maximum, std::string text) {
  ParameterInfo info{std::move(name), std::move(symbol), std::move(unit), std::move(text)};
  info.minimum = minimum;
  info.maximum = maximum;
  info.needs_reset = true;
  return {std::move(info), field};
}

void check_gap(std::size_t obstacle, const char* other, double gap, double spacing) {
  // Negated, so that a NaN fails it too.
  if (gap >= kSmallestGap * spacing) return;
  throw ParameterError(fmt::format("obstacles[{}] leaves a gap of {:.6g} m to {}; it must be at least 2 r = {:.6g} m",
                                   obstacle, gap, other, kSmallestGap * spacing));
}

void check_obstacle(const SimulatorParameters& parameters, std::size_t index) {
  const Sphere& sphere = parameters.obstacles[index];
  const double spacing = parameters.spacing;
  if (!sphere.center.allFinite()) {
    throw ParameterError(fmt::format("obstacles[{}].center is ({}, {}, {}) m; it must be finite", index,
                                     sphere.center.x(), sphere.center.y(), sphere.center.z()));
  }
  if (!(sphere.radius >= kSmallestObstacleRadius * spacing)) {
    throw ParameterError(fmt::format("obstacles[{}].radius is {} m; it must be at least 2 r = {} m", index,
                                     sphere.radius, kSmallestObstacleRadius * spacing));
  }
  const double farthest = sphere.center.head<2>().cwiseAbs().maxCoeff() + sphere.radius;
  check_gap(index, "a wall of the tank", parameters.tank_half_width - farthest, spacing);
  if (sphere.center.z() > 0.0) check_gap(index, "the floor", sphere.center.z() - sphere.radius, spacing);
  for (std::size_t other = 0; other < index; ++other) {
    const Sphere& before = parameters.obstacles[other];
    const double gap = (sphere.center - before.center).norm() - sphere.radius - before.radius;
    check_gap(index, fmt::format("obstacles[{}]", other).c_str(), gap, spacing);
  }
}

}  // namespace

const std::vector<SimulatorParameter>& simulator_parameter_table() {
  using P = SimulatorParameters;
  static const std::vector<SimulatorParameter> table = {
      real(&P::spacing, "spacing", "r", "m", kTiny, 1e3, "Distance between neighbouring particles at rest."),
      real(&P::frame_interval, "frame_interval", "", "s", 1e-4, 1.0, "Time from one output frame to the next."),
      real(&P::gravity, "gravity", "g", "m/s^2", 0.0, 1e3, "Acceleration of free fall, along -z."),
      real(&P::viscosity, "viscosity", "nu", "m^2/s", 0.0, 10.0, "Kinematic viscosity of the liquid."),
      real(&P::wall_friction, "wall_friction", "", "", 0.0, 1.0,
           "How strongly floor, walls and obstacles hold the liquid: 0 not at all, 1 like liquid at rest."),
      real(&P::tank_half_width, "tank_half_width", "", "m", kTiny, 1e6,
           "The walls stand this far from the z axis, along x and along y."),
      real(&P::cfl, "cfl", "", "r", 0.05, 1.0, "Particles move at most about this far in one substep."),
      real(&P::density_tolerance, "density_tolerance", "", "", 1e-5, 0.1,
           "The pressure solver ends when the mean error of the density is below this part of the rest density."),
  };
  return table;
}

void check_simulator_parameters(const SimulatorParameters& parameters) {
  for (const auto& [info, field] : simulator_parameter_table()) {
    const double value = parameters.*field;
    if (value >= info.minimum && value <= info.maximum) continue;
    const std::string found = fmt::format("{} is {}{}{}", info.name, value, info.unit.empty() ? "" : " ", info.unit);
    if (info.minimum == kTiny) {
      throw ParameterError(fmt::format("{}; it must be a positive number of at most {}", found, info.maximum));
    }
    throw ParameterError(fmt::format("{}; it must lie in [{}, {}]", found, info.minimum, info.maximum));
  }
  for (std::size_t index = 0; index < parameters.obstacles.size(); ++index) check_obstacle(parameters, index);
}

}  // namespace particle_surface_tracker::simulator
