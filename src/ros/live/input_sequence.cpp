#include "ros/live/input_sequence.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "particle_surface_tracker/ros/time_conversion.h"

namespace particle_surface_tracker {
namespace {

constexpr int kLateFramesOfANewRun = 3;
constexpr std::size_t kIntervals = 9;
constexpr std::size_t kIntervalsNeeded = 3;

std::int64_t median(const std::deque<std::int64_t>& values) {
  std::vector<std::int64_t> sorted(values.begin(), values.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

std::uint64_t minus(std::uint64_t a, std::uint64_t b) {
  return a > b ? a - b : 0;
}

}  // namespace

InputSequence::Judgement InputSequence::judge(const std_msgs::Header& header) {
  const std::int64_t stamp = to_nanoseconds(header.stamp);
  if (!started_) return begin(header, Verdict::kFirst);
  if (header.frame_id != frame_id_) return begin(header, Verdict::kOtherFrameId);
  if (stamp <= last_stamp_) {
    const Verdict verdict = judge_backward(stamp);
    if (verdict == Verdict::kWentBack) return begin(header, verdict);
    pass_over();
    return {verdict, index_, 0};
  }
  late_in_a_row_ = 0;
  const std::uint64_t missing = count_missing(header, stamp);
  index_ += 1 + passed_over_ + missing;
  passed_over_ = 0;
  last_stamp_ = stamp;
  last_number_ = header.seq;
  return {Verdict::kNext, index_, missing};
}

InputSequence::Judgement InputSequence::begin(const std_msgs::Header& header, Verdict verdict) {
  reset();
  started_ = true;
  frame_id_ = header.frame_id;
  first_stamp_ = last_stamp_ = to_nanoseconds(header.stamp);
  last_number_ = header.seq;
  return {verdict, 0, 0};
}

InputSequence::Verdict InputSequence::judge_backward(std::int64_t stamp) {
  if (stamp == last_stamp_) return Verdict::kRepeated;
  if (stamp <= first_stamp_) return Verdict::kWentBack;
  late_in_a_row_ = late_in_a_row_ > 0 && stamp > last_late_stamp_ ? late_in_a_row_ + 1 : 1;
  last_late_stamp_ = stamp;
  return late_in_a_row_ >= kLateFramesOfANewRun ? Verdict::kWentBack : Verdict::kLate;
}

std::uint64_t InputSequence::count_missing(const std_msgs::Header& header, std::int64_t stamp) {
  const std::uint64_t expected = passed_over_ + 1;
  const std::uint64_t step = header.seq > last_number_ ? header.seq - last_number_ : 0;
  if (step == expected) source_counts_ = true;
  const std::int64_t interval = stamp - last_stamp_;
  std::uint64_t missing = 0;
  if (source_counts_ && step != 0) {
    missing = minus(step, expected);
  } else if (intervals_.size() >= kIntervalsNeeded) {
    const double frames = static_cast<double>(interval) / static_cast<double>(median(intervals_));
    if (frames > 1.5 * static_cast<double>(expected)) {
      missing = minus(static_cast<std::uint64_t>(std::llround(frames)), expected);
    }
  }
  intervals_.push_back(interval / static_cast<std::int64_t>(expected + missing));
  if (intervals_.size() > kIntervals) intervals_.pop_front();
  return missing;
}

}  // namespace particle_surface_tracker
