#pragma once

#include <string>

#include "particle_surface_tracker/core/parameters.h"

namespace particle_surface_tracker {

/// Sets parameters from a YAML file that holds one map from names of parameter_table() to values. Parameters that the
/// file does not name keep their values; an empty file sets nothing.
/// \throw InputError if the file cannot be read or is not YAML.
/// \throw ParameterError, with file and line, if it is not a flat map, names a parameter twice, or as set_parameter().
/// `parameters` is unchanged then.
void read_parameter_file(const std::string& path, Parameters& parameters);

}  // namespace particle_surface_tracker
