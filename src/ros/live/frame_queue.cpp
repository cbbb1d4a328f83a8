#include "ros/live/frame_queue.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace particle_surface_tracker {

FrameQueue::FrameQueue(std::size_t limit, QueuePolicy policy) : limit_(limit), policy_(policy) {}

void FrameQueue::push(ReceivedFrame frame) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    frame.number = ++arrived_;
    bool begins = false;
    if (frame.reception == Reception::kUsable) {
      begins = begins_run(frame);
      if (policy_ == QueuePolicy::kLatest) {
        replace_waiting(/*with_begin*/ begins);
        ++clouds_;
      } else if (clouds_ < limit_) {
        ++clouds_;
      } else {
        // What waits comes before what arrives: the first frame is the one that the mesh belongs to.
        frame.reception = Reception::kDropped;
        frame.reason = fmt::format("the queue is full (queue_size is {})", limit_);
        frame.cloud.reset();
      }
    }
    places_.push_back({std::move(frame), begins});
    if (held_) let_go_ahead();
  }
  changed_.notify_one();
}

bool FrameQueue::begins_run(const ReceivedFrame& frame) {
  switch (arrivals_.judge(frame.header).verdict) {
    case InputSequence::Verdict::kFirst:
    case InputSequence::Verdict::kWentBack:
    case InputSequence::Verdict::kOtherFrameId:
      return true;
    default:
      return false;
  }
}

void FrameQueue::replace_waiting(bool with_begin) {
  for (Place& place : places_) {
    ReceivedFrame& waiting = place.frame;
    if (waiting.reception != Reception::kUsable || (place.begins_run && !with_begin)) continue;
    waiting.reception = Reception::kReplaced;
    waiting.reason = "a newer frame arrived before this one was tracked (queue_policy is latest)";
    waiting.cloud.reset();
    --clouds_;
  }
}

void FrameQueue::let_go_ahead() {
  if (places_.size() == clouds_) return;
  const auto lost = std::stable_partition(
      places_.begin(), places_.end(), [](const Place& place) { return place.frame.reception == Reception::kUsable; });
  for (auto place = lost; place != places_.end(); ++place) {
    place->frame.is_ahead = lost != places_.begin() && place->frame.number > places_.front().frame.number;
    ahead_.push_back(std::move(place->frame));
  }
  places_.erase(lost, places_.end());
}

void FrameQueue::push(Command command) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    commands_.push_back(std::move(command));
  }
  changed_.notify_one();
}

void FrameQueue::hold(bool held) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    held_ = held;
    if (held_) let_go_ahead();
  }
  changed_.notify_one();
}

void FrameQueue::close() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

bool FrameQueue::has_frame() const {
  return !ahead_.empty() || (!held_ && !places_.empty());
}

bool FrameQueue::wait(std::unique_lock<std::mutex>& lock, const std::optional<Time>& until) {
  const auto ready = [this] { return closed_ || !commands_.empty() || has_frame(); };
  if (until) return changed_.wait_until(lock, *until, ready);
  changed_.wait(lock, ready);
  return true;
}

std::optional<ReceivedFrame> FrameQueue::pop(std::optional<Time> until) {
  std::unique_lock<std::mutex> lock(mutex_);
  while (wait(lock, until) && !closed_) {
    if (!commands_.empty()) {
      const Command command = std::move(commands_.front());
      commands_.pop_front();
      lock.unlock();
      command();
      lock.lock();
      continue;
    }
    return take();
  }
  return std::nullopt;
}

ReceivedFrame FrameQueue::take() {
  ReceivedFrame frame = std::move(ahead_.empty() ? places_.front().frame : ahead_.front());
  if (ahead_.empty()) {
    places_.pop_front();
  } else {
    ahead_.pop_front();
  }
  if (frame.reception == Reception::kUsable) --clouds_;
  return frame;
}

bool FrameQueue::closed() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return closed_;
}

std::size_t FrameQueue::size() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return clouds_;
}

}  // namespace particle_surface_tracker
