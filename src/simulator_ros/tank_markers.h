#pragma once

#include <string>

#include <visualization_msgs/MarkerArray.h>

#include "simulator_parameters.h"

namespace particle_surface_tracker::simulator {

/// The floor and the obstacles of a tank for rviz.
visualization_msgs::MarkerArray make_tank_markers(const SimulatorParameters& parameters, const std::string& frame_id);

}  // namespace particle_surface_tracker::simulator
