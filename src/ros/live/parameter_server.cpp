#include "ros/live/parameter_server.h"

#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

using Description = TrackerConfig::AbstractParamDescription;
using dynamic_reconfigure::ConfigTools;

std::string value_of(const Description& description, const TrackerConfig& config) {
  boost::any value;
  description.getValue(config, value);
  if (description.type == "double") return fmt::format("{}", boost::any_cast<double>(value));
  if (description.type == "int") return fmt::format("{}", boost::any_cast<int>(value));
  return boost::any_cast<std::string>(value);
}

// Sets one value of a config, from text that is known to be good.
void set_value(const Description& description, const std::string& text, TrackerConfig& config) {
  dynamic_reconfigure::Config message;
  if (description.type == "double") {
    ConfigTools::appendParameter(message, description.name, std::stod(text));
  } else if (description.type == "int") {
    ConfigTools::appendParameter(message, description.name, std::stoi(text));
  } else {
    ConfigTools::appendParameter(message, description.name, text);
  }
  description.fromMessage(message, config);
}

// A config that has one of the ends of every number's slider.
TrackerConfig slider_ends(double ParameterInfo::*end) {
  TrackerConfig config = TrackerConfig::__getDefault__();
  for (const auto& description : TrackerConfig::__getParamDescriptions__()) {
    for (const ParameterInfo& info : parameter_table()) {
      if (info.name != description->name || info.type == ParameterInfo::Type::kChoice) continue;
      const bool is_real = info.type == ParameterInfo::Type::kReal;
      set_value(*description, is_real ? fmt::format("{}", info.*end) : fmt::format("{:.0f}", info.*end), config);
    }
  }
  return config;
}

// All that the server writes.
ParameterRecord::Texts texts_of(const Parameters& parameters) {
  ParameterRecord::Texts texts;
  for (const auto& description : TrackerConfig::__getParamDescriptions__()) {
    texts[description->name] = get_parameter(parameters, description->name);
  }
  return texts;
}

}  // namespace

TrackerConfig to_config(const Parameters& parameters) {
  TrackerConfig config = TrackerConfig::__getDefault__();
  for (const auto& description : TrackerConfig::__getParamDescriptions__()) {
    set_value(*description, get_parameter(parameters, description->name), config);
  }
  return config;
}

void apply_config(const TrackerConfig& config, Parameters& parameters) {
  Parameters changed = parameters;
  for (const auto& description : TrackerConfig::__getParamDescriptions__()) {
    set_parameter(changed, description->name, value_of(*description, config));
  }
  Parameters checked = changed;
  // The spacing may still have to be estimated; it is not to be judged here.
  checked.particle_spacing = 1.0;
  check_parameters(checked);
  parameters = changed;
}

ParameterServer::ParameterServer(const ros::NodeHandle& private_handle, const Parameters& initial,
                                 ParameterRecord record, Handler handler)
    : name_(private_handle.getNamespace()),
      wanted_(initial),
      record_(private_handle, std::move(record)),
      handler_(std::move(handler)) {
  record_.note(texts_of(initial));
  // The server begins with what it finds there.
  to_config(initial).__toServer__(private_handle);
  server_ = std::make_unique<dynamic_reconfigure::Server<TrackerConfig>>(mutex_, private_handle);
  server_->setConfigMin(slider_ends(&ParameterInfo::minimum));
  server_->setConfigMax(slider_ends(&ParameterInfo::slider_maximum));
  server_->setConfigDefault(to_config(Parameters()));
  server_->setCallback([this](TrackerConfig& config, std::uint32_t) { change(config); });
}

ParameterServer::~ParameterServer() {
  server_->clearCallback();
  server_.reset();
  record_.restore();
}

void ParameterServer::change(TrackerConfig& config) {
  Parameters changed = wanted_;
  try {
    apply_config(config, changed);
  } catch (const ParameterError& error) {
    ROS_WARN_STREAM(name_ << ": refused: " << error.what() << "; all parameters stay as they were");
    config = to_config(wanted_);
    return;
  }
  if (texts_of(changed) == texts_of(wanted_)) return;
  wanted_ = changed;
  record_.note(texts_of(wanted_));
  handler_(wanted_);
}

}  // namespace particle_surface_tracker
