#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include <sensor_msgs/PointCloud2.h>

#include "ros/input_sequence.h"

namespace particle_surface_tracker {

/// What happens to frames that arrive faster than they are tracked.
enum class QueuePolicy {
  kAll,     ///< They wait; where the queue is full, the one that arrives is dropped.
  kLatest,  ///< Only the newest waits, and the first of a run: to that one the mesh belongs.
  kStrict   ///< As kAll, but nothing is tracked any more after a gap.
};

/// What came of a message before the tracker has seen it.
enum class Reception { kUsable, kInvalid, kDropped, kReplaced };

/// A message that arrived.
struct ReceivedFrame {
  std_msgs::Header header;
  sensor_msgs::PointCloud2ConstPtr cloud;  ///< Null unless it is usable.
  Reception reception = Reception::kUsable;
  std::string reason;        ///< Why it is not usable.
  std::uint64_t number = 0;  ///< In the order of arrival, from 1 on.
  bool is_ahead = false;     ///< It left the row before others that had arrived earlier, because those are held.
  std::chrono::steady_clock::time_point arrival = std::chrono::steady_clock::now();
};

/// Hands frames, and commands that go first, from the callbacks to the one thread that tracks. Frames that are not
/// going to be tracked keep their place in the row, without their data, so that every frame is answered in order. Only
/// while frames are held they go ahead: a pause may last, and what is lost in it is to be known at once, and to take no
/// memory.
class FrameQueue {
 public:
  using Command = std::function<void()>;
  using Time = std::chrono::steady_clock::time_point;

  /// \param limit clouds that may wait, at least 1.
  FrameQueue(std::size_t limit, QueuePolicy policy);

  void push(ReceivedFrame frame);
  void push(Command command);

  /// While frames are held, pop() returns none that is usable. Commands run, and what is not usable goes ahead of what
  /// waits.
  void hold(bool held);

  /// Ends the waiting of pop(), now and for ever.
  void close();

  /// The next frame; runs the commands that were given before.
  /// \param until gives up at this time; without it, never.
  /// \return nothing if the queue was closed or the time is over.
  std::optional<ReceivedFrame> pop(std::optional<Time> until);

  bool closed() const;

  /// Clouds that wait.
  std::size_t size() const;

 private:
  // A frame whose data waits, or not any more.
  struct Place {
    ReceivedFrame frame;
    bool begins_run = false;
  };

  bool wait(std::unique_lock<std::mutex>& lock, const std::optional<Time>& until);
  bool has_frame() const;
  bool begins_run(const ReceivedFrame& frame);
  void replace_waiting(bool with_begin);
  void let_go_ahead();
  ReceivedFrame take();

  const std::size_t limit_;
  const QueuePolicy policy_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Place> places_;
  std::deque<ReceivedFrame> ahead_;  // What is not usable and stood behind frames that are held.
  InputSequence arrivals_;           // Usable frames, as they arrive.
  std::deque<Command> commands_;
  std::size_t clouds_ = 0;
  std::uint64_t arrived_ = 0;
  bool held_ = false;
  bool closed_ = false;
};

}  // namespace particle_surface_tracker
