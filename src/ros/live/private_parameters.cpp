#include "ros/live/private_parameters.h"

#include <charconv>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

template <typename Number>
Number parse(const std::string& name, const std::string& text, Number minimum, Number maximum, const char* kind) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !(value >= minimum && value <= maximum)) {
    throw ParameterError(fmt::format("~{} is '{}'; it must be {} in [{}, {}]", name, text, kind, minimum, maximum));
  }
  return value;
}

}  // namespace

std::optional<std::string> PrivateParameters::text(const std::string& name) {
  known_.insert(name);
  XmlRpc::XmlRpcValue value;
  if (!handle_.getParam(name, value)) return std::nullopt;
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

bool PrivateParameters::flag(const std::string& name, bool otherwise) {
  const auto value = text(name);
  if (!value) return otherwise;
  if (*value == "true") return true;
  if (*value == "false") return false;
  throw ParameterError(fmt::format("~{} is '{}'; it must be true or false", name, *value));
}

double PrivateParameters::real(const std::string& name, double otherwise, double minimum, double maximum) {
  const auto value = text(name);
  return value ? parse(name, *value, minimum, maximum, "a number") : otherwise;
}

long PrivateParameters::whole(const std::string& name, long otherwise, long minimum, long maximum) {
  const auto value = text(name);
  return value ? parse(name, *value, minimum, maximum, "a whole number") : otherwise;
}

std::vector<std::string> PrivateParameters::unknown() const {
  std::vector<std::string> names;
  handle_.getParamNames(names);
  const std::string prefix = handle_.getNamespace() + "/";
  std::vector<std::string> unknown;
  for (const std::string& name : names) {
    if (name.compare(0, prefix.size(), prefix) != 0) continue;
    const std::string own = name.substr(prefix.size());
    if (known_.count(own) == 0) unknown.push_back(own);
  }
  return unknown;
}

}  // namespace particle_surface_tracker
