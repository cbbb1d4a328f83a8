#include "simulator_node.h"

#include <algorithm>

#include <fmt/format.h>
#include <particle_surface_tracker/TrackerStatus.h>
#include <ros/callback_queue.h>
#include <rosgraph_msgs/Clock.h>

#include "particle_surface_tracker/io/mesh_writer.h"
#include "tank_markers.h"
#include "timeout_error.h"

namespace particle_surface_tracker::simulator {
namespace {

constexpr std::uint32_t kQueueSize = 10;
constexpr std::uint32_t kStatusQueueSize = 100;
constexpr int kFramesPerMessage = 10;
const ros::WallDuration kNap(0.02);
const ros::WallDuration kReminderInterval(10.0);
// roscpp drops what is still in its queues when it shuts down.
const ros::WallDuration kTimeToSend(1.0);

}  // namespace

SimulatorNode::SimulatorNode(ros::NodeHandle handle, ros::NodeHandle private_handle)
    : settings_(read_node_settings(private_handle)), simulation_(settings_.simulation), audience_(settings_.wait_for) {
  if (!settings_.mesh_out.empty()) write_ply(settings_.mesh_out, simulation_.scene().mesh);
  if (!settings_.wall_time) clock_ = handle.advertise<rosgraph_msgs::Clock>("/clock", kQueueSize);
  if (settings_.max_ahead > 0) {
    const boost::function<void(const TrackerStatusConstPtr&)> note = [this](const TrackerStatusConstPtr& status) {
      last_status_ = std::max(last_status_, status->header.stamp);
    };
    status_ = handle.subscribe<TrackerStatus>("status", kStatusQueueSize, note);
  }
  tank_ = private_handle.advertise<visualization_msgs::MarkerArray>("tank", 1, /*latch*/ true);
  tank_.publish(make_tank_markers(simulation_.scene().parameters, settings_.simulation.frame_id));
  particles_ = handle.advertise<sensor_msgs::PointCloud2>(
      "particles", kQueueSize,
      [this](const ros::SingleSubscriberPublisher& subscriber) { audience_.arrive(subscriber); });
}

void SimulatorNode::run() {
  wait_for_audience();
  const int count = simulation_.frame_count();
  do {
    const int frame = simulation_.frame();
    if (settings_.max_ahead > 0) wait_for_status_of(frame - settings_.max_ahead);
    if (!ros::ok()) return;
    publish_frame();
    if (frame % kFramesPerMessage == 0) ROS_INFO("frame %d of %d", frame, count);
  } while (simulation_.advance());
  if (settings_.max_ahead > 0) wait_for_status_of(count - 1);
  ROS_INFO("all %d frames are published", count);
  kTimeToSend.sleep();
}

void SimulatorNode::wait_for_audience() {
  // Others may wait for the clock before they subscribe.
  const ros::Time first = simulation_.cloud()->header.stamp;
  wait_until(
      [&] {
        publish_clock(first);
        return audience_.is_complete() && (settings_.max_ahead == 0 || status_.getNumPublishers() > 0);
      },
      [&] {
        if (!audience_.is_complete()) {
          return fmt::format("{} to subscribe to {}", audience_.missing(), particles_.getTopic());
        }
        return fmt::format("a tracker to publish {}", status_.getTopic());
      });
}

void SimulatorNode::publish_frame() {
  const sensor_msgs::PointCloud2Ptr cloud = simulation_.cloud();
  ros::Time& stamp = cloud->header.stamp;
  if (settings_.wall_time) {
    const ros::WallTime now = ros::WallTime::now();
    if (stamps_.empty()) wall_offset_ = ros::Time(now.sec, now.nsec) - stamp;
    stamp += wall_offset_;
    ros::WallTime::sleepUntil(ros::WallTime(stamp.sec, stamp.nsec));
  }
  publish_clock(stamp);
  stamps_.push_back(stamp);
  particles_.publish(cloud);
}

void SimulatorNode::wait_for_status_of(int frame) {
  if (frame < 0) return;
  const ros::Time stamp = stamps_[static_cast<std::size_t>(frame)];
  wait_until([&] { return last_status_ >= stamp; },
             [&] { return fmt::format("{} to report frame {}", status_.getTopic(), frame); });
}

void SimulatorNode::publish_clock(const ros::Time& time) const {
  if (settings_.wall_time) return;
  rosgraph_msgs::Clock clock;
  clock.clock = time;
  clock_.publish(clock);
}

void SimulatorNode::wait_until(const std::function<bool()>& done, const std::function<std::string()>& missing) const {
  const ros::WallTime start = ros::WallTime::now();
  ros::WallTime reminded = start;
  while (ros::ok()) {
    ros::getGlobalCallbackQueue()->callAvailable(kNap);
    if (done()) return;
    const ros::WallTime now = ros::WallTime::now();
    if (settings_.timeout > 0.0 && (now - start).toSec() > settings_.timeout) {
      throw TimeoutError(fmt::format("waited {} s in vain for {}", settings_.timeout, missing()));
    }
    if (now - reminded > kReminderInterval) {
      ROS_INFO("still waiting for %s", missing().c_str());
      reminded = now;
    }
  }
}

}  // namespace particle_surface_tracker::simulator
