#pragma once

#include <functional>
#include <string>
#include <vector>

#include <ros/ros.h>

#include "audience.h"
#include "node_settings.h"
#include "simulation.h"

namespace particle_surface_tracker::simulator {

/// Publishes a simulation frame by frame, from the first one on: it waits for those who listen, and keeps pace with the
/// tracker. Topics and parameters are described in docs/simulator.md.
class SimulatorNode {
 public:
  /// \throw ParameterError, ParticleError as read_node_settings() and Simulation. OutputError if the mesh of the first
  /// frame cannot be written.
  SimulatorNode(ros::NodeHandle handle, ros::NodeHandle private_handle);

  /// Publishes all frames. Returns early when ROS shuts down.
  /// \throw TimeoutError if another node lets it wait too long. ParticleError as Simulation::advance().
  void run();

 private:
  void wait_for_audience();
  void publish_frame();
  void wait_for_status_of(int frame);
  void publish_clock(const ros::Time& time) const;

  // Handles callbacks until `done`, for as long as ROS runs.
  // \param missing says what is waited for.
  // \throw TimeoutError if that takes too long.
  void wait_until(const std::function<bool()>& done, const std::function<std::string()>& missing) const;

  NodeSettings settings_;
  Simulation simulation_;
  Audience audience_;
  std::vector<ros::Time> stamps_;  // Of all frames that were published.
  ros::Duration wall_offset_;      // From simulated time to the time of day.
  ros::Time last_status_;          // Stamp of the latest frame that the tracker has reported.
  ros::Publisher particles_;
  ros::Publisher tank_;
  ros::Publisher clock_;
  ros::Subscriber status_;
};

}  // namespace particle_surface_tracker::simulator
