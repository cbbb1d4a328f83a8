#include "input_sequence.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "particle_surface_tracker/core/error.h"
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
  // passed_over_ never comes near the largest number, which alone would make this 0.
  const auto frames = std::max<std::int64_t>(static_cast<std::int64_t>(expected + missing), 1);
  intervals_.push_back(interval / frames);
  if (intervals_.size() > kIntervals) intervals_.pop_front();
  return missing;
}

void InputSequence::put(ByteWriter& bytes) const {
  bytes.put(static_cast<std::uint8_t>(started_));
  bytes.put(std::string_view(frame_id_));
  bytes.put(index_);
  bytes.put(passed_over_);
  bytes.put(first_stamp_);
  bytes.put(last_stamp_);
  bytes.put(last_late_stamp_);
  bytes.put(static_cast<std::int32_t>(late_in_a_row_));
  bytes.put(last_number_);
  bytes.put(static_cast<std::uint8_t>(source_counts_));
  bytes.put(std::vector<std::int64_t>(intervals_.begin(), intervals_.end()));
}

InputSequence InputSequence::take(ByteReader& bytes) {
  InputSequence sequence;
  sequence.started_ = bytes.number<std::uint8_t>("beginning of the run") != 0;
  sequence.frame_id_ = bytes.text("frame_id of the run");
  sequence.index_ = bytes.number<std::uint64_t>("index of the last frame");
  sequence.passed_over_ = bytes.number<std::uint64_t>("number of frames passed over");
  sequence.first_stamp_ = bytes.number<std::int64_t>("first stamp");
  sequence.last_stamp_ = bytes.number<std::int64_t>("last stamp");
  sequence.last_late_stamp_ = bytes.number<std::int64_t>("last late stamp");
  sequence.late_in_a_row_ = bytes.number<std::int32_t>("number of late frames");
  sequence.last_number_ = bytes.number<std::uint32_t>("last sequence number");
  sequence.source_counts_ = bytes.number<std::uint8_t>("kind of sequence numbers") != 0;
  const auto intervals = bytes.numbers<std::int64_t>("interval of stamps");
  sequence.intervals_.assign(intervals.begin(), intervals.end());
  const bool has_intervals =
      std::all_of(intervals.begin(), intervals.end(), [](std::int64_t interval) { return interval >= 0; });
  if (!sequence.started_ || sequence.first_stamp_ > sequence.last_stamp_ || !has_intervals ||
      intervals.size() > kIntervals) {
    throw InputError("its stamps do not fit together");
  }
  return sequence;
}

bool InputSequence::covers(const std_msgs::Header& header) const {
  const std::int64_t stamp = to_nanoseconds(header.stamp);
  return started_ && header.frame_id == frame_id_ && stamp >= first_stamp_ && stamp <= last_stamp_;
}

void InputSequence::note_again(const std_msgs::Header& header) {
  if (to_nanoseconds(header.stamp) == last_stamp_) last_number_ = header.seq;
}

}  // namespace particle_surface_tracker
