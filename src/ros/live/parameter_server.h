#pragma once

#include <functional>
#include <memory>
#include <string>

#include <dynamic_reconfigure/server.h>
#include <particle_surface_tracker/TrackerConfig.h>

#include "particle_surface_tracker/core/parameters.h"
#include "ros/live/parameter_record.h"

namespace particle_surface_tracker {

/// The values of all parameters as dynamic_reconfigure has them, all but particle_spacing.
TrackerConfig to_config(const Parameters& parameters);

/// Reads values back.
/// \param parameters keeps particle_spacing.
/// \throw ParameterError as set_parameter() and check_parameters(); `parameters` is unchanged then.
void apply_config(const TrackerConfig& config, Parameters& parameters);

/// The dynamic_reconfigure server of a node. A value out of the range of parameter_table() is refused, said, and the
/// value before it shown again, where dynamic_reconfigure by itself would silently take the nearest. The ranges that it
/// describes to others are those of sliders, which may end earlier: a value beyond is shown and taken as any other.
/// What is shown are the values that are wanted; whether they are in force already is said in the diagnostics.
class ParameterServer {
 public:
  /// Receives valid parameters, on the thread of the service call.
  using Handler = std::function<void(const Parameters&)>;

  /// \param record of those that the node comes up with.
  ParameterServer(const ros::NodeHandle& private_handle, const Parameters& initial, ParameterRecord record,
                  Handler handler);

  /// Takes what was written to the parameter server away again.
  ~ParameterServer();

 private:
  void change(TrackerConfig& config);

  std::string name_;
  boost::recursive_mutex mutex_;  // Of the next two, and of the server.
  Parameters wanted_;
  ParameterRecordKeeper record_;
  Handler handler_;
  std::unique_ptr<dynamic_reconfigure::Server<TrackerConfig>> server_;
};

}  // namespace particle_surface_tracker
