#include "ros_live/node_process.h"

#include <ros/network.h>
#include <ros/ros.h>
#include <xmlrpcpp/XmlRpc.h>

#include "ros_live/live_node.h"

namespace particle_surface_tracker::test {

namespace {

// Asks a node something.
bool ask(const std::string& node, const std::string& question, XmlRpc::XmlRpcValue& answer) {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue uri;
  request[0] = ros::this_node::getName();
  request[1] = node;
  if (!ros::master::execute("lookupNode", request, response, uri, /*wait_for_master*/ false)) return false;
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(static_cast<std::string>(uri), host, port)) return false;
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port));
  XmlRpc::XmlRpcValue caller;
  caller[0] = ros::this_node::getName();
  return client.execute(question.c_str(), caller, answer) && !client.isFault();
}

}  // namespace

pid_t process_of(const std::string& node) {
  XmlRpc::XmlRpcValue answer;
  return ask(node, "getPid", answer) ? static_cast<int>(answer[2]) : 0;
}

int connection_count(const std::string& node, const std::string& topic) {
  XmlRpc::XmlRpcValue answer;
  if (!ask(node, "getBusInfo", answer)) return 0;
  int count = 0;
  for (int n = 0; n < answer[2].size(); ++n) {
    XmlRpc::XmlRpcValue& connection = answer[2][n];
    count += static_cast<std::string>(connection[2]) == "i" && static_cast<std::string>(connection[4]) == topic ? 1 : 0;
  }
  return count;
}

pid_t kill_node(const std::string& node, int signal) {
  const pid_t process = process_of(node);
  if (process != 0) kill(process, signal);
  return process;
}

bool wait_for_respawn(const std::string& node, pid_t killed) {
  return wait_until([&] {
    const pid_t process = process_of(node);
    return process != 0 && process != killed;
  });
}

}  // namespace particle_surface_tracker::test
