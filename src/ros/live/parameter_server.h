#pragma once

#include <functional>
#include <memory>
#include <string>

#include <dynamic_reconfigure/server.h>
#include <particle_surface_tracker/TrackerConfig.h>

#include "particle_surface_tracker/core/parameters.h"

namespace particle_surface_tracker {

/// The values of all parameters as dynamic_reconfigure has them, all but particle_spacing.
TrackerConfig to_config(const Parameters& parameters);

/// Reads values back.
/// \param parameters keeps particle_spacing.
/// \throw ParameterError as set_parameter() and check_parameters(); `parameters` is unchanged then.
void apply_config(const TrackerConfig& config, Parameters& parameters);

/// The dynamic_reconfigure server of a node. A value out of the range of parameter_table() is refused, said, and the
/// value in force shown again, where dynamic_reconfigure by itself would silently take the nearest. The ranges that it
/// describes to others are those of sliders, which may end earlier: a value beyond is shown and taken as any other.
class ParameterServer {
 public:
  /// Receives valid parameters, on the thread of the service call.
  using Handler = std::function<void(const Parameters&)>;

  ParameterServer(const ros::NodeHandle& private_handle, const Parameters& initial, Handler handler);
  ~ParameterServer();

  /// Shows these values; they are taken to be in force.
  void show(const Parameters& parameters);

 private:
  void change(TrackerConfig& config);

  std::string name_;
  boost::recursive_mutex mutex_;  // Of in_force_, and of the server.
  Parameters in_force_;
  Handler handler_;
  std::unique_ptr<dynamic_reconfigure::Server<TrackerConfig>> server_;
};

}  // namespace particle_surface_tracker
