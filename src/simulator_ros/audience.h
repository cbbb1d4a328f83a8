#pragma once

#include <set>
#include <string>
#include <vector>

#include <ros/single_subscriber_publisher.h>

namespace particle_surface_tracker::simulator {

/// Knows which of the nodes that must not miss a frame listen to a topic.
class Audience {
 public:
  /// \param expected full names of nodes; none: any one node will do.
  explicit Audience(const std::vector<std::string>& expected) : expected_(expected.begin(), expected.end()) {}

  void arrive(const ros::SingleSubscriberPublisher& subscriber) { present_.insert(subscriber.getSubscriberName()); }

  bool is_complete() const;

  /// The names of those who are not there yet, for a user.
  std::string missing() const;

 private:
  std::set<std::string> expected_;
  std::set<std::string> present_;
};

}  // namespace particle_surface_tracker::simulator
