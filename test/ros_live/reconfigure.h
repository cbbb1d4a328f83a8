#pragma once

#include <stdexcept>
#include <string>

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <dynamic_reconfigure/config_tools.h>

#include "ros_live/live_node.h"

namespace particle_surface_tracker::test {

/// dynamic_reconfigure of a node, as a user of it sees it.
class Reconfigure {
 public:
  explicit Reconfigure(const std::string& node) : node_(node), updates_(node + "/parameter_updates") {
    updates_.wait_for(1);
  }

  /// Asks for a value; returns the values that are wanted after that.
  template <typename Value>
  dynamic_reconfigure::Config set(const std::string& name, const Value& value) {
    dynamic_reconfigure::Reconfigure call;
    dynamic_reconfigure::ConfigTools::appendParameter(call.request.config, name, value);
    if (!ros::service::call(node_ + "/set_parameters", call)) throw std::runtime_error("no reconfigure");
    return call.response.config;
  }

  Collector<dynamic_reconfigure::Config>& updates() { return updates_; }

 private:
  std::string node_;
  Collector<dynamic_reconfigure::Config> updates_;
};

template <typename Value>
Value value_of(const dynamic_reconfigure::Config& config, const std::string& name) {
  Value value{};
  if (!dynamic_reconfigure::ConfigTools::getParameter(config, name, value)) throw std::runtime_error("no " + name);
  return value;
}

}  // namespace particle_surface_tracker::test
