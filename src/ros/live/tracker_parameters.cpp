#include "ros/live/tracker_parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/parameter_file.h"
#include "ros/live/parameter_text.h"

namespace particle_surface_tracker {
namespace {

const std::string* find(const ParameterRecord::Texts& texts, const std::string& name) {
  const auto found = texts.find(name);
  return found == texts.end() ? nullptr : &found->second;
}

void set(Parameters& parameters, const std::string& name, const std::string& value) {
  try {
    set_parameter(parameters, name, value);
  } catch (const ParameterError& error) {
    throw ParameterError(fmt::format("~{}", error.what()));
  }
}

/// Tells the values that lie on the server apart by their origin.
class Reader {
 public:
  Reader(const ParameterRecord& left, TrackerParameters& result) : left_(left), result_(result) {}

  void read(const std::string& name, const XmlRpc::XmlRpcValue& value) {
    const std::string* written = find(left_.written, name);
    const auto text = text_of_parameter(name, value);
    if (written == nullptr || text != *written) {
      take_given(name, value);
      return;
    }
    const auto given = left_.given.find(name);
    if (given != left_.given.end()) take_given(name, given->second);
    const std::string configured = get_parameter(result_.configured, name);
    if (*text == configured) return;
    const std::string* then = find(left_.configured, name);
    const std::string change = fmt::format("{} {} -> {}", name, configured, *text);
    if (then == nullptr || *then != configured) {
      outdated_.push_back(fmt::format("{} = {} (not {})", name, configured, *text));
      return;
    }
    set_parameter(result_.wanted, name, *text);
    kept_.push_back(change);
  }

  void say_what_became_of_them() const {
    const char* before = "a node of this name has not ended in order";
    if (!kept_.empty()) {
      result_.notes.push_back(
          fmt::format("{}; what dynamic_reconfigure had changed stays so: {}", before, fmt::join(kept_, ", ")));
    }
    if (!outdated_.empty()) {
      result_.notes.push_back(fmt::format("{}; ~config has changed since, and what it says now holds: {}", before,
                                          fmt::join(outdated_, ", ")));
    }
  }

 private:
  void take_given(const std::string& name, const XmlRpc::XmlRpcValue& value) {
    const auto text = to_text(name, value);
    if (!text) return;
    set(result_.configured, name, *text);
    set(result_.wanted, name, *text);
    result_.record.given[name] = value;
  }

  const ParameterRecord& left_;
  TrackerParameters& result_;
  std::vector<std::string> kept_;
  std::vector<std::string> outdated_;
};

}  // namespace

TrackerParameters read_tracker_parameters(PrivateParameters& source, const ros::NodeHandle& private_handle) {
  TrackerParameters result;
  if (const auto path = source.text("config")) read_parameter_file(*path, result.configured);
  result.wanted = result.configured;
  source.pass_over(parameter_record_name);
  const ParameterRecord left = read_parameter_record(private_handle);
  Reader reader(left, result);
  for (const ParameterInfo& info : parameter_table()) {
    const XmlRpc::XmlRpcValue value = source.value(info.name);
    if (!value.valid()) continue;
    if (info.name == "particle_spacing") throw ParameterError("~particle_spacing is set by ~spacing");
    reader.read(info.name, value);
  }
  reader.say_what_became_of_them();
  for (const ParameterInfo& info : parameter_table()) {
    if (info.name == "particle_spacing") continue;
    result.record.configured[info.name] = get_parameter(result.configured, info.name);
  }
  return result;
}

}  // namespace particle_surface_tracker
