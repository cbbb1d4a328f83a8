#pragma once

#include <optional>
#include <string>

#include "particle_surface_tracker/ros/offline_runner.h"

namespace particle_surface_tracker {

/// What a command line asks for: a run, or a text to print.
struct CommandLine {
  std::optional<OfflineOptions> options;
  std::string text;  ///< Of --help or --version, where there are no options.
};

/// \throw ParameterError if the command line is wrong, or a parameter that it or its parameter file sets.
/// \throw InputError as read_parameter_file().
CommandLine read_command_line(int argc, const char* const* argv);

}  // namespace particle_surface_tracker
