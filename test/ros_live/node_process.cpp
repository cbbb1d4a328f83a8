#include "ros_live/node_process.h"

#include <csignal>

#include <ros/network.h>
#include <ros/ros.h>
#include <xmlrpcpp/XmlRpc.h>

#include "ros_live/live_node.h"

namespace particle_surface_tracker::test {

pid_t process_of(const std::string& node) {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue uri;
  request[0] = ros::this_node::getName();
  request[1] = node;
  if (!ros::master::execute("lookupNode", request, response, uri, /*wait_for_master*/ false)) return 0;
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(static_cast<std::string>(uri), host, port)) return 0;
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port));
  XmlRpc::XmlRpcValue caller;
  caller[0] = ros::this_node::getName();
  XmlRpc::XmlRpcValue answer;
  if (!client.execute("getPid", caller, answer) || client.isFault()) return 0;
  return static_cast<int>(answer[2]);
}

pid_t kill_node(const std::string& node) {
  const pid_t process = process_of(node);
  if (process != 0) kill(process, SIGKILL);
  return process;
}

bool wait_for_respawn(const std::string& node, pid_t killed) {
  return wait_until([&] {
    const pid_t process = process_of(node);
    return process != 0 && process != killed;
  });
}

}  // namespace particle_surface_tracker::test
