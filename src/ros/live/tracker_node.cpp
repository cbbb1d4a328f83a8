#include "ros/live/tracker_node.h"

#include <algorithm>
#include <utility>

namespace particle_surface_tracker {
namespace {

// roscpp's own queue drops silently. It is emptied at once, and long enough for that never to happen before the queue
// of the node is full, which says what it drops.
constexpr std::size_t kSmallestSubscriberQueue = 100;

}  // namespace

TrackerNode::TrackerNode(ros::NodeHandle handle, const ros::NodeHandle& private_handle)
    : TrackerNode(std::move(handle), private_handle, read_node_options(private_handle)) {}

TrackerNode::TrackerNode(ros::NodeHandle handle, ros::NodeHandle private_handle, const NodeOptions& options)
    : outputs_(private_handle, options.marker),
      worker_(options, outputs_, private_handle.getNamespace()),
      parameter_server_(private_handle, options.handler.parameters,
                        [this](const Parameters& parameters) { worker_.set_parameters(parameters, [] {}); }) {
  for (const std::string& warning : options.warnings) ROS_WARN_STREAM(private_handle.getNamespace() << ": " << warning);
  reset_service_ = private_handle.advertiseService("reset", &TrackerNode::reset, this);
  particles_ = handle.subscribe<sensor_msgs::PointCloud2>(
      "particles", static_cast<std::uint32_t>(std::max(options.queue_size, kSmallestSubscriberQueue)),
      [this](const sensor_msgs::PointCloud2ConstPtr& cloud) { worker_.receive(cloud); }, ros::VoidConstPtr(),
      ros::TransportHints().tcpNoDelay());
}

TrackerNode::~TrackerNode() {
  // In this order, so that nothing is called any more that is gone.
  particles_.shutdown();
  reset_service_.shutdown();
  worker_.stop();
}

bool TrackerNode::reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  worker_.reset();
  response.success = 1;
  response.message = "the next frame starts the tracker with the initial mesh";
  return true;
}

}  // namespace particle_surface_tracker
