#pragma once

#include <map>
#include <string>

#include <ros/node_handle.h>

namespace particle_surface_tracker {

/// Where the values come from that lie on the parameter server. dynamic_reconfigure writes all of them there, and the
/// next node of the same name would take them for given by a user, who would then change ~config in vain. So what a
/// node writes is recorded beside it, until the node ends in order and takes both away.
struct ParameterRecord {
  using Texts = std::map<std::string, std::string>;

  Texts written;  ///< What the node has written, by name, as get_parameter() gives it.

  /// The values without dynamic_reconfigure, by name: those of ~config, or of a parameter that was given beside it.
  Texts configured;

  std::map<std::string, XmlRpc::XmlRpcValue> given;  ///< The latter, as they were given.
};

/// Name of the private parameter that holds it.
constexpr const char* parameter_record_name = "parameter_record";

/// What a node of this name has left that did not end in order; empty if there is nothing, or nothing of the kind.
ParameterRecord read_parameter_record(const ros::NodeHandle& private_handle);

/// The record of a node that runs.
class ParameterRecordKeeper {
 public:
  ParameterRecordKeeper(const ros::NodeHandle& private_handle, ParameterRecord record);

  /// Records what is going to be written; to be called before it is, so that whatever lies there is known.
  void note(const ParameterRecord::Texts& written);

  /// Takes away what was written: all is as it was before the node came up. What somebody else has set since stays, and
  /// everything does if another node has taken the name over.
  void restore();

 private:
  bool is_own() const;

  ros::NodeHandle handle_;
  std::string writer_;  // Of this process; another node of the same name has another.
  ParameterRecord record_;
};

}  // namespace particle_surface_tracker
