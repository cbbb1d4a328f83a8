#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>

#include <ros/ros.h>

namespace particle_surface_tracker {

/// The moments at which messages of a topic arrive.
template <typename Message>
class Arrivals {
 public:
  using Clock = std::chrono::steady_clock;

  /// Waits for a publisher.
  explicit Arrivals(const std::string& topic) {
    subscriber_ =
        ros::NodeHandle().subscribe<Message>(topic, 100, [this](const boost::shared_ptr<const Message>& message) {
          const std::lock_guard<std::mutex> lock(mutex_);
          last_ = message;
          time_ = Clock::now();
          ++count_;
          arrived_.notify_all();
        });
    while (subscriber_.getNumPublishers() == 0) ros::WallDuration(0.01).sleep();
  }

  /// Waits until so many have arrived.
  /// \return when the last one so far did.
  Clock::time_point wait_for(int count) {
    std::unique_lock<std::mutex> lock(mutex_);
    arrived_.wait(lock, [&] { return count_ >= count; });
    return time_;
  }

  boost::shared_ptr<const Message> last() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return last_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  boost::shared_ptr<const Message> last_;
  Clock::time_point time_;
  int count_ = 0;
  ros::Subscriber subscriber_;
};

}  // namespace particle_surface_tracker
