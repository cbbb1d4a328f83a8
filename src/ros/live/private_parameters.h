#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include <ros/node_handle.h>

namespace particle_surface_tracker {

/// Reads private parameters whatever type a launch file gave them, and remembers which were asked for.
class PrivateParameters {
 public:
  explicit PrivateParameters(const ros::NodeHandle& handle) : handle_(handle) {}

  /// The value as it is set; invalid if it is not.
  XmlRpc::XmlRpcValue value(const std::string& name);

  /// The value as text, of a number, flag or string; nothing if it is not set, or an empty string.
  /// \throw ParameterError if it is a list or a map.
  std::optional<std::string> text(const std::string& name);

  /// \throw ParameterError if it is not true or false.
  bool flag(const std::string& name, bool otherwise);

  /// \throw ParameterError if it is no number in [minimum, maximum].
  double real(const std::string& name, double otherwise, double minimum, double maximum);

  /// \throw ParameterError if it is no whole number in [minimum, maximum].
  long whole(const std::string& name, long otherwise, long minimum, long maximum);

  /// A parameter, or a map of them, that is not for users.
  void pass_over(const std::string& name) { known_.insert(name); }

  /// Parameters that are set and that nobody asked for.
  std::vector<std::string> unknown() const;

 private:
  ros::NodeHandle handle_;
  std::set<std::string> known_;
};

}  // namespace particle_surface_tracker
