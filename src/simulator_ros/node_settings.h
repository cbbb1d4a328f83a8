#pragma once

#include <string>
#include <vector>

#include <ros/node_handle.h>

#include "simulation.h"

namespace particle_surface_tracker::simulator {

/// Everything that private parameters of simulator_node set; docs/simulator.md describes them for users.
struct NodeSettings {
  SimulationSettings simulation;
  std::string mesh_out;               ///< Path for the mesh of the first frame; empty: it is not written.
  bool wall_time = false;             ///< Stamps are the time of day, and frames keep pace with it; no clock.
  std::vector<std::string> wait_for;  ///< Full names of the nodes that must listen; none: any one node.
  int max_ahead = 0;                  ///< Frames ahead of the tracker's status; 0: as fast as it goes.
  double timeout = 0.0;               ///< Longest wait for another node [s of wall time]; 0: for ever.
};

/// \throw ParameterError that names the parameter, its value and what it must be; for an unknown parameter, too.
NodeSettings read_node_settings(const ros::NodeHandle& private_handle);

}  // namespace particle_surface_tracker::simulator
