#include "ros/live/waiting_parameters.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/byte_stream.h"
#include "ros/parameter_agreement.h"

namespace particle_surface_tracker {
namespace {

// The spacing is none of them: it cannot be reconfigured, and may have been estimated.
const std::vector<std::string>& names_of_those_that_wait() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> found;
    for (const ParameterInfo& info : parameter_table()) {
      if (info.needs_reset && info.name != "particle_spacing") found.push_back(info.name);
    }
    return found;
  }();
  return names;
}

Parameters configured_there(const Checkpoint& checkpoint) try {
  Parameters configured = checkpoint.tracker.parameters;
  const auto section = checkpoint.sections.find(configured_section);
  if (section == checkpoint.sections.end()) return configured;
  ByteReader bytes(section->second);
  for (const std::string& expected : names_of_those_that_wait()) {
    if (bytes.text("name of a parameter") != expected) throw InputError(fmt::format("no {}", expected));
    set_parameter(configured, expected, bytes.text("value of a parameter"));
  }
  bytes.expect_end();
  return configured;
} catch (const Error& error) {
  throw InputError(fmt::format("what the checkpoint says of configured parameters is damaged: {}", error.what()));
}

}  // namespace

std::string to_bytes(const Parameters& configured) {
  ByteWriter bytes;
  for (const std::string& name : names_of_those_that_wait()) {
    bytes.put(std::string_view(name));
    bytes.put(std::string_view(get_parameter(configured, name)));
  }
  return bytes.bytes();
}

void require_not_configured_otherwise(const Checkpoint& checkpoint, const Parameters& configured, bool any_spacing) {
  const Parameters there = configured_there(checkpoint);
  Parameters judged = configured;
  for (const std::string& name : names_of_those_that_wait()) {
    if (get_parameter(configured, name) != get_parameter(there, name)) continue;
    set_parameter(judged, name, get_parameter(checkpoint.tracker.parameters, name));
  }
  require_agreement(checkpoint.tracker.parameters, judged, Agreement::kWhatNeedsReset, any_spacing);
}

Parameters with_values_in_force(Parameters wanted, const Parameters& in_force) {
  for (const std::string& name : names_of_those_that_wait()) {
    set_parameter(wanted, name, get_parameter(in_force, name));
  }
  return wanted;
}

std::string describe_waiting(const Parameters& in_force, const Parameters& wanted) {
  std::vector<std::string> waiting;
  for (const std::string& name : names_of_those_that_wait()) {
    const std::string now = get_parameter(in_force, name);
    const std::string then = get_parameter(wanted, name);
    if (now != then) waiting.push_back(fmt::format("{} {} -> {}", name, now, then));
  }
  return fmt::format("{}", fmt::join(waiting, ", "));
}

}  // namespace particle_surface_tracker
