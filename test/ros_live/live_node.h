#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <nodelet/loader.h>
#include <particle_surface_tracker/TrackedMesh.h>
#include <particle_surface_tracker/TrackerStatus.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>

#include "particle_surface_tracker/core/triangle_mesh.h"
#include "particle_surface_tracker/ros/frame_handler.h"

namespace particle_surface_tracker::test {

/// Longest wait for something that has to happen; the machine may be busy.
constexpr std::chrono::seconds kPatience{60};

/// Keeps the messages of a topic, of this process or another.
template <typename Message>
class Collector {
 public:
  using ConstPtr = boost::shared_ptr<const Message>;

  explicit Collector(const std::string& topic) {
    subscriber_ = ros::NodeHandle().subscribe<Message>(topic, 1000, [this](const ConstPtr& message) {
      const std::lock_guard<std::mutex> lock(mutex_);
      messages_.push_back(message);
      arrived_.notify_all();
    });
  }
  ~Collector() { subscriber_.shutdown(); }

  /// Waits until there are so many.
  /// \return all there are, maybe fewer if patience ends.
  std::vector<ConstPtr> wait_for(std::size_t count, std::chrono::milliseconds patience = kPatience) {
    std::unique_lock<std::mutex> lock(mutex_);
    arrived_.wait_for(lock, patience, [&] { return messages_.size() >= count; });
    return messages_;
  }

  bool wait_for_publisher(std::uint32_t count = 1) const;

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<ConstPtr> messages_;
  ros::Subscriber subscriber_;
};

/// Waits until something holds. False if patience ends.
template <typename Condition>
bool wait_until(Condition&& condition) {
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    ros::WallDuration(0.002).sleep();
  }
  return true;
}

template <typename Message>
bool Collector<Message>::wait_for_publisher(std::uint32_t count) const {
  return wait_until([&] { return subscriber_.getNumPublishers() >= count; });
}

/// Particle spacing of the ball [m].
constexpr double kBallSpacing = 0.2;

/// Frame n of a ball of liquid of radius 1 that moves by r / 16 along x in every frame: stamp 1000 s + n / 100 s,
/// sequence number n, frame_id "tank".
sensor_msgs::PointCloud2Ptr ball_cloud(int n);

/// The mesh of frame 0.
TriangleMesh ball_mesh();

/// Frame n of two drops that merge, with the ball's spacing, stamps and frame_id.
sensor_msgs::PointCloud2Ptr drops_cloud(int n);

/// A tracker that is loaded into the nodelet manager of this process, with the ball's spacing.
class LiveNode {
 public:
  /// Sets the parameters and loads.
  /// \param mesh file.
  LiveNode(nodelet::Loader& manager, std::string name, const std::string& mesh,
           const std::map<std::string, std::string>& parameters = {});
  ~LiveNode();
  LiveNode(const LiveNode&) = delete;
  LiveNode& operator=(const LiveNode&) = delete;

  /// Whether the manager could load it.
  bool loaded() const { return loaded_; }

  /// Where the node takes its particles from.
  std::string input() const { return name_ + "/in"; }
  const std::string& name() const { return name_; }

  /// Publishes a cloud, without a copy.
  void send(const sensor_msgs::PointCloud2ConstPtr& cloud) { publisher_.publish(cloud); }
  void send(int n) { send(ball_cloud(n)); }

  /// Sends a cloud and waits for its answer.
  TrackerStatus answer(const sensor_msgs::PointCloud2ConstPtr& cloud);
  TrackerStatus answer(int n) { return answer(ball_cloud(n)); }

  Collector<TrackerStatus>& statuses() { return statuses_; }

 private:
  nodelet::Loader& manager_;
  std::string name_;
  ros::Publisher publisher_;
  Collector<TrackerStatus> statuses_;
  bool loaded_ = false;
};

/// The bytes of a message; sequence numbers, which roscpp changes on the way, left out.
template <typename Message>
std::string bytes_of(Message message) {
  message.header.seq = 0;
  const std::uint32_t size = ros::serialization::serializationLength(message);
  std::string bytes(size, '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(bytes.data()), size);
  ros::serialization::serialize(stream, message);
  return bytes;
}

}  // namespace particle_surface_tracker::test
