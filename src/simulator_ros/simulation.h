#pragma once

#include <cstdint>
#include <string>

#include <sensor_msgs/PointCloud2.h>

#include "falling_ring.h"
#include "fluid_simulator.h"

namespace particle_surface_tracker::simulator {

/// What a user can set about a run, beside the numbers of SimulatorParameters.
struct SimulationSettings {
  SimulatorParameters parameters = falling_ring_parameters();
  int frames = 130;
  double start_time = 1000.0;      ///< Stamp of the first frame [s].
  std::string frame_id = "world";  ///< Of the clouds.
};

/// Checks everything but `parameters`, which the simulator checks.
/// \throw ParameterError that names the setting, its value and what it must be.
void check_simulation_settings(const SimulationSettings& settings);

/// The falling ring as a sequence of clouds: the same bytes for a topic and for a bag.
class Simulation {
 public:
  /// \throw ParameterError, ParticleError as check_simulation_settings(), falling_ring() and FluidSimulator.
  explicit Simulation(const SimulationSettings& settings);

  /// The mesh of the first frame, and what stands in the tank.
  const Scene& scene() const { return scene_; }

  int frame_count() const { return frame_count_; }

  /// Index of the frame that cloud() is.
  int frame() const { return frame_; }

  /// The particles with ids and velocities; header.stamp is the simulated time, header.seq the index of the frame.
  sensor_msgs::PointCloud2Ptr cloud() const;

  /// What the frame took to simulate.
  const SimulationReport& report() const { return simulator_.report(); }

  /// Simulates the next frame; false if the last one is there already.
  /// \throw ParticleError as FluidSimulator::step().
  bool advance();

 private:
  int frame_count_;
  std::string frame_id_;
  Scene scene_;
  FluidSimulator simulator_;
  int frame_ = 0;
};

}  // namespace particle_surface_tracker::simulator
