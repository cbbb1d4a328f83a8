#include "ros/live/marker_outputs.h"

#include <utility>

namespace particle_surface_tracker {

using visualization_msgs::Marker;

MarkerOutputs::MarkerOutputs(ros::NodeHandle private_handle, const MarkerOptions& options) : options_(options) {
  mesh_publisher_ = private_handle.advertise<Marker>(
      "marker", 1, [this](const ros::SingleSubscriberPublisher& subscriber) { welcome(subscriber, /*to_mesh*/ true); });
  surface_publisher_ = private_handle.advertise<Marker>(
      "surface_marker", 1,
      [this](const ros::SingleSubscriberPublisher& subscriber) { welcome(subscriber, /*to_mesh*/ false); });
  topology_publisher_ = private_handle.advertise<visualization_msgs::MarkerArray>("topology_marker", 10);
}

MarkerOutputs::~MarkerOutputs() {
  // Ends the calls of this object before its members go.
  mesh_publisher_.shutdown();
  surface_publisher_.shutdown();
}

void MarkerOutputs::show(std::shared_ptr<const TrackedView> view) {
  if (shows_topology()) topology_.remember(*view);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    view_ = std::move(view);
  }
  if (!has_subscribers()) return;
  waits_ = true;
  if (std::chrono::steady_clock::now() >= due_) publish_due();
}

bool MarkerOutputs::has_subscribers() const {
  return mesh_publisher_.getNumSubscribers() + surface_publisher_.getNumSubscribers() +
             topology_publisher_.getNumSubscribers() >
         0;
}

void MarkerOutputs::clear() {
  waits_ = false;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (view_ == nullptr) return;
  const std_msgs::Header& header = view_->mesh->header;
  mesh_publisher_.publish(make_mesh_marker_removal(header));
  surface_publisher_.publish(make_surface_marker_removal(header));
  topology_publisher_.publish(topology_.remove(header));
  view_.reset();
}

std::optional<std::chrono::steady_clock::time_point> MarkerOutputs::due() const {
  if (!waits_) return std::nullopt;
  return due_;
}

void MarkerOutputs::publish_due() {
  waits_ = false;
  const std::chrono::duration<double> period(1.0 / options_.max_rate);
  due_ = std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::nanoseconds>(period);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (view_ == nullptr) return;
  if (mesh_publisher_.getNumSubscribers() > 0) mesh_publisher_.publish(make_mesh_marker(*view_, options_.coloring));
  if (surface_publisher_.getNumSubscribers() > 0) surface_publisher_.publish(make_surface_marker(*view_));
  if (shows_topology()) topology_publisher_.publish(topology_.show(*view_));
}

void MarkerOutputs::welcome(const ros::SingleSubscriberPublisher& subscriber, bool to_mesh) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (view_ == nullptr) return;
  subscriber.publish(to_mesh ? *make_mesh_marker(*view_, options_.coloring) : *make_surface_marker(*view_));
}

}  // namespace particle_surface_tracker
