#pragma once

#include <functional>
#include <string>
#include <thread>

#include <particle_surface_tracker/TrackerStatus.h>
#include <sensor_msgs/PointCloud2.h>

#include "particle_surface_tracker/ros/frame_handler.h"
#include "ros/live/frame_queue.h"
#include "ros/live/input_sequence.h"
#include "ros/live/node_options.h"
#include "ros/live/node_outputs.h"
#include "ros/live/throttled_log.h"

namespace particle_surface_tracker {

/// Tracks on a thread of its own, the only one that touches the tracker. Other threads hand it frames and commands.
class TrackingWorker {
 public:
  /// \param name of the node, for the log.
  /// \param outputs outlives this object.
  /// \throw ParameterError as FrameHandler.
  TrackingWorker(NodeOptions options, NodeOutputs& outputs, const std::string& name);
  ~TrackingWorker();

  /// Checks the layout of a cloud and puts it in the row. Answers within microseconds.
  void receive(const sensor_msgs::PointCloud2ConstPtr& cloud);

  /// After the frame in work: the next one starts the tracker anew.
  void reset();

  /// After the frame in work: takes over new parameters.
  /// \param refuse is called, on the worker's thread, if they cannot be taken over.
  void set_parameters(const Parameters& parameters, std::function<void()> refuse);

  /// Ends after the frame in work.
  void stop();

 private:
  void run();
  void process(const ReceivedFrame& frame);
  void process_usable(const ReceivedFrame& frame, TrackerStatus& status);
  void process_unusable(const ReceivedFrame& frame, TrackerStatus& status);
  // Whether the frame is to be tracked; if not, the status says why.
  bool admit(const ReceivedFrame& frame, TrackerStatus& status);
  void track(const ReceivedFrame& frame, TrackerStatus& status);
  void describe(const FrameReport& report, TrackerStatus& status) const;
  void forget_run();
  void publish(const ReceivedFrame& frame, TrackerStatus status);

  MessageContent content_;
  NodeOutputs& outputs_;
  ThrottledLog log_;
  FrameQueue queue_;
  FrameHandler handler_;
  InputSequence sequence_;
  TrackerStatus counts_;  // Only its counters are used.
  std::thread thread_;    // Last: it uses all others.
};

}  // namespace particle_surface_tracker
