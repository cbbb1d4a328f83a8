#include "particle_surface_tracker/io/parameter_file.h"

#include <set>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "file_bytes.h"
#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

std::string place(const std::string& path, const YAML::Node& node) {
  return fmt::format("parameter file '{}', line {}", path, node.Mark().line + 1);
}

YAML::Node load(const std::string& path) {
  try {
    return YAML::Load(read_file(path));
  } catch (const YAML::ParserException& error) {
    throw InputError(
        fmt::format("parameter file '{}', line {}: not valid YAML: {}", path, error.mark.line + 1, error.msg));
  }
}

void set_from_entry(const std::string& path, const YAML::Node& key, const YAML::Node& value,
                    std::set<std::string>& seen, Parameters& parameters) {
  if (!key.IsScalar()) throw ParameterError(place(path, key) + ": a parameter's name must be plain text");
  const std::string& name = key.Scalar();
  if (!seen.insert(name).second) throw ParameterError(fmt::format("{}: '{}' is set twice", place(path, key), name));
  if (!value.IsScalar()) {
    throw ParameterError(fmt::format("{}: '{}' must have one number or word as its value", place(path, key), name));
  }
  try {
    set_parameter(parameters, name, value.Scalar());
  } catch (const ParameterError& error) {
    throw ParameterError(fmt::format("{}: {}", place(path, key), error.what()));
  }
}

}  // namespace

void read_parameter_file(const std::string& path, Parameters& parameters) {
  const YAML::Node root = load(path);
  if (root.IsNull()) return;
  if (!root.IsMap()) throw ParameterError(place(path, root) + ": expected lines of the form 'name: value'");
  Parameters changed = parameters;
  std::set<std::string> seen;
  for (const auto& entry : root) set_from_entry(path, entry.first, entry.second, seen, changed);
  parameters = changed;
}

}  // namespace particle_surface_tracker
