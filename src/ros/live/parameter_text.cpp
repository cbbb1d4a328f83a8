#include "ros/live/parameter_text.h"

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/parameters.h"

namespace particle_surface_tracker {

std::optional<std::string> to_text(const std::string& name, XmlRpc::XmlRpcValue value) {
  switch (value.getType()) {
    case XmlRpc::XmlRpcValue::TypeBoolean:
      return static_cast<bool>(value) ? "true" : "false";
    case XmlRpc::XmlRpcValue::TypeInt:
      return fmt::format("{}", static_cast<int>(value));
    case XmlRpc::XmlRpcValue::TypeDouble:
      return fmt::format("{}", static_cast<double>(value));
    case XmlRpc::XmlRpcValue::TypeString:
      break;
    default:
      throw ParameterError(fmt::format("~{} is a list or a map; it must be a single value", name));
  }
  const auto string = static_cast<std::string>(value);
  return string.empty() ? std::nullopt : std::make_optional(string);
}

std::optional<std::string> text_of_parameter(const std::string& name, const XmlRpc::XmlRpcValue& value) try {
  const auto text = to_text(name, value);
  if (!text) return std::nullopt;
  Parameters parameters;
  set_parameter(parameters, name, *text);
  return get_parameter(parameters, name);
} catch (const ParameterError&) {
  return std::nullopt;
}

}  // namespace particle_surface_tracker
