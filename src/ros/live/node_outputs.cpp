#include "ros/live/node_outputs.h"

#include <utility>

#include <visualization_msgs/Marker.h>

#include "ros/live/mesh_marker.h"

namespace particle_surface_tracker {
namespace {

constexpr std::uint32_t kMeshQueue = 10;
constexpr std::uint32_t kStatusQueue = 1000;  // Small, and a player that is paced by them must see each.

}  // namespace

NodeOutputs::NodeOutputs(ros::NodeHandle private_handle, const MarkerOptions& marker_options)
    : marker_options_(marker_options) {
  mesh_publisher_ = private_handle.advertise<TrackedMesh>(
      "mesh", kMeshQueue, [this](const ros::SingleSubscriberPublisher& subscriber) { welcome_to_mesh(subscriber); });
  marker_publisher_ = private_handle.advertise<visualization_msgs::Marker>(
      "marker", 1, [this](const ros::SingleSubscriberPublisher& subscriber) { welcome_to_marker(subscriber); });
  status_publisher_ = private_handle.advertise<TrackerStatus>("status", kStatusQueue);
}

NodeOutputs::~NodeOutputs() {
  // Ends the calls of this object before its members go.
  mesh_publisher_.shutdown();
  marker_publisher_.shutdown();
}

void NodeOutputs::publish(TrackedMeshConstPtr mesh) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    last_mesh_ = std::move(mesh);
    mesh_publisher_.publish(last_mesh_);
  }
  if (marker_publisher_.getNumSubscribers() == 0) return;
  marker_waits_ = true;
  if (std::chrono::steady_clock::now() >= marker_due_) publish_due_marker();
}

void NodeOutputs::clear() {
  marker_waits_ = false;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!last_mesh_) return;
  marker_publisher_.publish(make_marker_removal(last_mesh_->header));
  last_mesh_.reset();
}

std::optional<std::chrono::steady_clock::time_point> NodeOutputs::marker_due() const {
  if (!marker_waits_) return std::nullopt;
  return marker_due_;
}

void NodeOutputs::publish_due_marker() {
  marker_waits_ = false;
  const std::chrono::duration<double> period(1.0 / marker_options_.max_rate);
  marker_due_ = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::nanoseconds>(period);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (last_mesh_) marker_publisher_.publish(make_marker(*last_mesh_, marker_options_.colors));
}

void NodeOutputs::welcome_to_mesh(const ros::SingleSubscriberPublisher& subscriber) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (last_mesh_) subscriber.publish(last_mesh_);
}

void NodeOutputs::welcome_to_marker(const ros::SingleSubscriberPublisher& subscriber) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (last_mesh_) subscriber.publish(*make_marker(*last_mesh_, marker_options_.colors));
}

}  // namespace particle_surface_tracker
