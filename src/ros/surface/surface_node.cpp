#include "ros/surface/surface_node.h"

#include <utility>

#include <fmt/format.h>
#include <boost/make_shared.hpp>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/parameter_file.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "particle_surface_tracker/tracker/make_implicit_surface.h"
#include "ros/live/private_parameters.h"
#include "ros/surface/surface_conversion.h"
#include "ros/surface/surface_identity.h"

namespace particle_surface_tracker {
namespace {

constexpr double kSecondsBetweenWarnings = 5.0;

void read_parameters(PrivateParameters& source, Parameters& parameters) {
  if (const auto path = source.text("config")) read_parameter_file(*path, parameters);
  for (const std::string& name : surface_parameters()) {
    // Each surface must be that of the tracker, so the spacing cannot be estimated frame by frame.
    const std::string parameter = name == "particle_spacing" ? "spacing" : name;
    const auto value = source.text(parameter);
    if (!value) continue;
    try {
      set_parameter(parameters, name, *value);
    } catch (const ParameterError& error) {
      throw ParameterError(fmt::format("~{} is '{}': {}", parameter, *value, error.what()));
    }
  }
  check_parameters(parameters);
}

}  // namespace

SurfaceNodeOptions read_surface_node_options(const ros::NodeHandle& private_handle) {
  SurfaceNodeOptions options;
  PrivateParameters source(private_handle);
  read_parameters(source, options.parameters);
  options.queue_size = static_cast<std::uint32_t>(source.whole("queue_size", 50, 1, 1000000));
  options.every = static_cast<std::uint64_t>(source.whole("every", 1, 1, 1000));
  options.offset = static_cast<std::uint64_t>(source.whole("offset", 0, 0, static_cast<long>(options.every) - 1));
  for (const std::string& name : source.unknown()) {
    ROS_WARN_STREAM(private_handle.getNamespace() << ": there is no parameter ~" << name << "; it is set in vain");
  }
  return options;
}

SurfaceNode::SurfaceNode(ros::NodeHandle handle, const ros::NodeHandle& private_handle)
    : name_(private_handle.getNamespace()), options_(read_surface_node_options(private_handle)) {
  surfaces_ = handle.advertise<ParticleSurface>("surfaces", options_.queue_size);
  particles_ = handle.subscribe<sensor_msgs::PointCloud2>(
      "particles", options_.queue_size, [this](const sensor_msgs::PointCloud2ConstPtr& cloud) { receive(cloud); },
      ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
}

SurfaceNode::~SurfaceNode() {
  particles_.shutdown();
}

bool SurfaceNode::is_mine(const std_msgs::Header& header) {
  // All nodes see the same sequence numbers, whenever they came up. Within a process nobody sets them: then count.
  const std::uint64_t number = header.seq != 0 ? header.seq : received_;
  ++received_;
  return number % options_.every == options_.offset;
}

void SurfaceNode::receive(const sensor_msgs::PointCloud2ConstPtr& cloud) {
  if (!is_mine(cloud->header) || surfaces_.getNumSubscribers() == 0) return;
  try {
    const ParticleFrame particles = to_particle_frame(*cloud);
    if (particles.empty()) return;
    const auto surface = make_implicit_surface(particles, options_.parameters);
    auto message = boost::make_shared<ParticleSurface>(
        to_surface_message(cloud->header, *surface, particles, options_.parameters));
    message->every = static_cast<std::uint32_t>(options_.every);
    message->offset = static_cast<std::uint32_t>(options_.offset);
    surfaces_.publish(ParticleSurfaceConstPtr(std::move(message)));
  } catch (const std::exception& error) {
    ROS_WARN_STREAM_THROTTLE(kSecondsBetweenWarnings, name_ << ": no surface of the frame of stamp "
                                                            << cloud->header.stamp << ": " << error.what());
  }
}

}  // namespace particle_surface_tracker
