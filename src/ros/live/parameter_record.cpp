#include "ros/live/parameter_record.h"

#include <utility>

#include <ros/xmlrpc_manager.h>

#include "ros/live/parameter_text.h"

namespace particle_surface_tracker {
namespace {

using Value = XmlRpc::XmlRpcValue;

// A map without entries has no type that the server knows.
template <typename Map>
Value to_value(const Map& map) {
  Value value;
  value.begin();  // Makes a map of it.
  for (const auto& [name, entry] : map) value[name] = entry;
  return value;
}

Value part_of(Value& value, const char* name) {
  const bool has_it = value.getType() == Value::TypeStruct && value.hasMember(name);
  return has_it && value[name].getType() == Value::TypeStruct ? value[name] : Value();
}

ParameterRecord::Texts texts_of(const Value& value) {
  ParameterRecord::Texts texts;
  if (value.getType() != Value::TypeStruct) return texts;
  for (const auto& [name, entry] : value) {
    if (entry.getType() == Value::TypeString) texts[name] = static_cast<std::string>(entry);
  }
  return texts;
}

}  // namespace

ParameterRecord read_parameter_record(const ros::NodeHandle& private_handle) {
  ParameterRecord record;
  Value value;
  if (!private_handle.getParam(parameter_record_name, value)) return record;
  record.written = texts_of(part_of(value, "written"));
  record.configured = texts_of(part_of(value, "configured"));
  Value given = part_of(value, "given");
  if (given.getType() == Value::TypeStruct) record.given.insert(given.begin(), given.end());
  return record;
}

ParameterRecordKeeper::ParameterRecordKeeper(const ros::NodeHandle& private_handle, ParameterRecord record)
    : handle_(private_handle), writer_(ros::XMLRPCManager::instance()->getServerURI()), record_(std::move(record)) {}

void ParameterRecordKeeper::note(const ParameterRecord::Texts& written) {
  record_.written = written;
  Value value;
  value["writer"] = writer_;
  value["written"] = to_value(record_.written);
  value["configured"] = to_value(record_.configured);
  value["given"] = to_value(record_.given);
  handle_.setParam(parameter_record_name, value);
}

bool ParameterRecordKeeper::is_own() const {
  std::string writer;
  return handle_.getParam(std::string(parameter_record_name) + "/writer", writer) && writer == writer_;
}

void ParameterRecordKeeper::restore() {
  if (!is_own()) return;
  for (const auto& [name, text] : record_.written) {
    Value now;
    if (!handle_.getParam(name, now) || text_of_parameter(name, now) != text) continue;
    const auto given = record_.given.find(name);
    if (given == record_.given.end()) {
      handle_.deleteParam(name);
    } else {
      handle_.setParam(name, given->second);
    }
  }
  handle_.deleteParam(parameter_record_name);
}

}  // namespace particle_surface_tracker
