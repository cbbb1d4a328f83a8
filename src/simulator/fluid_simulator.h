#pragma once

#include <cstdint>
#include <vector>

#include "boundary.h"
#include "particle_surface_tracker/core/particle_frame.h"
#include "pressure_solver.h"
#include "simulator_parameters.h"
#include "surroundings.h"
#include "viscosity_solver.h"

namespace particle_surface_tracker::simulator {

/// What one frame took.
struct SimulationReport {
  int substeps = 0;
  int pressure_iterations = 0;   ///< Of all substeps.
  int viscosity_iterations = 0;  ///< Of all substeps.
  double density_error = 0.0;    ///< Largest of the pressure solver's mean errors, relative to the rest density.
  double densest = 0.0;          ///< Highest density of a particle in any substep, relative to the rest density.
  double fastest = 0.0;          ///< Speed of the fastest particle at the end [m/s].
};

/// A viscous, incompressible liquid of particles, by smoothed particle hydrodynamics: it falls, splits, merges and
/// comes to rest in a tank with obstacles. Same input gives the same bytes, for any number of threads.
///
///     FluidSimulator simulator(parameters, start);
///     publish(simulator.frame());
///     for (int n = 1; n < frames; ++n) publish(simulator.step());
class FluidSimulator {
 public:
  /// \param start the particles at the beginning; velocities may be missing and are 0 then. Their stamp is that of the
  /// first frame.
  /// \throw ParameterError as check_simulator_parameters(). ParticleError where there are no particles, a number is not
  /// finite, an id occurs twice, a particle is nearer than r/2 to a wall or obstacle, or the particles are much denser
  /// than the spacing says.
  FluidSimulator(const SimulatorParameters& parameters, const ParticleFrame& start);

  /// The latest frame, in the order of the ids. Velocities are those at the middle of the last substep.
  const ParticleFrame& frame() const { return frame_; }

  /// Goes on to the next frame, in as many substeps as the speed of the particles asks for.
  /// \throw ParticleError if that is more than 1000, or if a particle has left the range of the lattice.
  const ParticleFrame& step();

  const SimulationReport& report() const { return report_; }

 private:
  void check_start();
  void sort_particles();
  double fastest() const;
  double pressure_speed() const;
  double longest_substep() const;
  void advance(double duration);
  void write_frame();

  SimulatorParameters parameters_;
  Boundary boundary_;
  Surroundings surroundings_;
  PressureSolver pressure_;
  ViscositySolver viscosity_;

  // The particles in the order of the grid.
  std::vector<std::uint32_t> places_;  // In the frame.
  std::vector<Vec3d> positions_;       // [m]
  std::vector<Vec3f> velocities_;      // At the middle of the last substep [m/s].
  std::vector<float> multipliers_;     // Of the pressure solver, for a substep of previous_duration_ [m²].

  std::vector<Vec3f> displacements_;  // In the substep [m].
  double previous_duration_ = 0.0;    // Of a substep [s].
  std::int64_t first_stamp_ns_;
  std::int64_t frames_ = 0;
  ParticleFrame frame_;
  SimulationReport report_;
};

}  // namespace particle_surface_tracker::simulator
