#include "ros/live/node_outputs.h"

#include <utility>

namespace particle_surface_tracker {
namespace {

constexpr std::uint32_t kMeshQueue = 10;
constexpr std::uint32_t kStatusQueue = 1000;  // Small, and a player that is paced by them must see each.

}  // namespace

NodeOutputs::NodeOutputs(ros::NodeHandle private_handle, const MarkerOptions& marker_options)
    : markers_(private_handle, marker_options) {
  mesh_publisher_ = private_handle.advertise<TrackedMesh>(
      "mesh", kMeshQueue, [this](const ros::SingleSubscriberPublisher& subscriber) { welcome_to_mesh(subscriber); });
  status_publisher_ = private_handle.advertise<TrackerStatus>("status", kStatusQueue);
}

NodeOutputs::~NodeOutputs() {
  // Ends the calls of this object before its members go.
  mesh_publisher_.shutdown();
}

void NodeOutputs::publish(std::shared_ptr<const TrackedView> view) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    last_mesh_ = view->mesh;
    mesh_publisher_.publish(last_mesh_);
  }
  markers_.show(std::move(view));
}

void NodeOutputs::clear() {
  markers_.clear();
  const std::lock_guard<std::mutex> lock(mutex_);
  last_mesh_.reset();
}

TrackedMeshConstPtr NodeOutputs::last_mesh() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_mesh_;
}

void NodeOutputs::welcome_to_mesh(const ros::SingleSubscriberPublisher& subscriber) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (last_mesh_) subscriber.publish(last_mesh_);
}

}  // namespace particle_surface_tracker
