#pragma once

#include <vector>

#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker::simulator {

/// A solid ball that liquid cannot enter.
struct Sphere {
  Vec3d center{0.0, 0.0, 0.0};  ///< [m]
  double radius = 0.0;          ///< [m]
};

/// Everything a user can set about a simulation. Down is −z, the floor of the tank is z = 0, and its four walls stand
/// at x, y = ±tank_half_width without a lid. Names, units, ranges and texts for users are in
/// simulator_parameter_table().
struct SimulatorParameters {
  double spacing = 0.0;                // r: distance between neighbouring particles at rest [m]. Has no default.
  double frame_interval = 1.0 / 60.0;  // Time from one output frame to the next [s].
  double gravity = 9.81;               // [m/s²], along −z.
  double viscosity = 0.2;              // Kinematic viscosity ν [m²/s]; water has 1e-6, honey about 5e-3.
  double wall_friction = 0.1;          // Part of the drag of walls made of the same liquid, at rest; 0 slides.
  double tank_half_width = 1.5;        // [m]
  double cfl = 0.4;                    // Particles move at most about this far in one substep [r].
  double density_tolerance = 0.002;    // The pressure solver ends at this mean error, relative to the rest density.
  std::vector<Sphere> obstacles = {};  // Solid balls in the tank.
};

/// A number in SimulatorParameters and what users need to know about it.
struct SimulatorParameter {
  ParameterInfo info;
  double SimulatorParameters::*field;
};

/// All numbers in the order of the struct; obstacles are not among them.
const std::vector<SimulatorParameter>& simulator_parameter_table();

/// Checks every value, and the obstacles: each lies inside the walls and has a gap of at least 2 r to them, to other
/// obstacles, and, unless its centre is not above it, to the floor, so that liquid never gets stuck in a wedge.
/// \throw ParameterError that names the parameter, its value and what it must be.
void check_simulator_parameters(const SimulatorParameters& parameters);

}  // namespace particle_surface_tracker::simulator
