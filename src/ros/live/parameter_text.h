#pragma once

#include <optional>
#include <string>

#include <xmlrpcpp/XmlRpcValue.h>

namespace particle_surface_tracker {

/// A number, flag or string of the parameter server as text; nothing if it is an empty string.
/// \throw ParameterError if it is a list or a map.
/// \param name for the error.
std::optional<std::string> to_text(const std::string& name, XmlRpc::XmlRpcValue value);

/// A parameter of the tracker as get_parameter() gives it, however the server holds it (1, 1.0, "1").
/// \return nothing if it is not valid.
std::optional<std::string> text_of_parameter(const std::string& name, const XmlRpc::XmlRpcValue& value);

}  // namespace particle_surface_tracker
