#pragma once

#include <string>
#include <vector>

#include "particle_surface_tracker/core/parameters.h"
#include "ros/live/parameter_record.h"
#include "ros/live/private_parameters.h"

namespace particle_surface_tracker {

/// The parameters of the tracker that a node comes up with.
struct TrackerParameters {
  Parameters configured;  ///< As ~config and the parameters beside it have them.
  Parameters wanted;      ///< With what dynamic_reconfigure had changed when a node of this name died.
  ParameterRecord record;
  std::vector<std::string> notes;  ///< What became of the values of a node that died, in words.
};

/// Reads them from ~config first, then one by one. A value that a node has written and left behind, because it did not
/// end in order, is no value that a user gave: it goes on where ~config says of it what it said then, and else gives
/// way.
/// \throw ParameterError, InputError as set_parameter() and read_parameter_file().
TrackerParameters read_tracker_parameters(PrivateParameters& source, const ros::NodeHandle& private_handle);

}  // namespace particle_surface_tracker
