#include "ros/live/private_parameters.h"

#include <charconv>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "ros/live/parameter_text.h"

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

XmlRpc::XmlRpcValue PrivateParameters::value(const std::string& name) {
  known_.insert(name);
  XmlRpc::XmlRpcValue value;
  return handle_.getParam(name, value) ? value : XmlRpc::XmlRpcValue();
}

std::optional<std::string> PrivateParameters::text(const std::string& name) {
  const XmlRpc::XmlRpcValue set = value(name);
  return set.valid() ? to_text(name, set) : std::nullopt;
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
    if (known_.count(own.substr(0, own.find('/'))) == 0) unknown.push_back(own);
  }
  return unknown;
}

}  // namespace particle_surface_tracker
