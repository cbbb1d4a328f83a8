#include "ros/live/frame_admission.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <zlib.h>

#include "particle_surface_tracker/ros/time_conversion.h"

namespace particle_surface_tracker {
namespace {

std::uint32_t checksum_of(const sensor_msgs::PointCloud2& cloud) {
  return static_cast<std::uint32_t>(::crc32_z(::crc32_z(0, nullptr, 0), cloud.data.data(), cloud.data.size()));
}

std::string stamp_of(const std_msgs::Header& header) {
  return fmt::format("stamp {}.{:09}", header.stamp.sec, header.stamp.nsec);
}

std::string count_missing(std::uint64_t count) {
  return count == 1 ? "1 frame is missing" : fmt::format("{} frames are missing", count);
}

}  // namespace

FrameAdmission::Verdict FrameAdmission::judge(const ReceivedFrame& frame, TrackerStatus& status) {
  if (!frame.is_ahead) pass_over_those_ahead(frame);
  if (policy_ == QueuePolicy::kStrict && !is_in_gap(frame) && frame.reception == Reception::kDropped) {
    open_gap(frame, fmt::format("{} at the frame of {}", frame.reason, stamp_of(frame.header)));
  }
  if (is_in_gap(frame)) {
    refuse(status);
    return Verdict::kRefused;
  }
  if (frame.reception == Reception::kUsable) {
    if (!came_before(frame)) return judge_header(frame, status);
    sequence_.note_again(frame.header);
    status.state = TrackerStatus::SKIPPED;
    status.reason = "it is not later than the last frame of the checkpoint that the run went on from";
    return Verdict::kRefused;
  }
  if (!frame.is_ahead) sequence_.pass_over();
  status.reason = frame.reason;
  status.state = frame.reception == Reception::kDropped    ? TrackerStatus::DROPPED
                 : frame.reception == Reception::kReplaced ? TrackerStatus::SKIPPED
                                                           : TrackerStatus::INVALID;
  return Verdict::kRefused;
}

void FrameAdmission::pass_over_those_ahead(const ReceivedFrame& frame) {
  sequence_.pass_over(frame.number - last_number_ - 1);
  last_number_ = frame.number;
}

bool FrameAdmission::came_before(const ReceivedFrame& frame) {
  if (!went_on_) return false;
  const bool covered = sequence_.covers(frame.header);
  if (covered &&
      (to_nanoseconds(frame.header.stamp) != start_.stamp_ns || checksum_of(*frame.cloud) == start_.checksum)) {
    return true;
  }
  went_on_ = false;
  if (covered) {
    log_.warn(
        "the particles are others than those that the run of the checkpoint began with: the tracker starts again");
    sequence_.reset();
  }
  return false;
}

FrameAdmission::Verdict FrameAdmission::judge_header(const ReceivedFrame& frame, TrackerStatus& status) {
  using Sequence = InputSequence::Verdict;
  const InputSequence::Judgement judgement = sequence_.judge(frame.header);
  status.frame = judgement.index;
  switch (judgement.verdict) {
    case Sequence::kRepeated:
    case Sequence::kLate:
      status.state = TrackerStatus::SKIPPED;
      status.reason = judgement.verdict == Sequence::kRepeated ? "its stamp is that of the frame before"
                                                               : "its stamp is below that of the frame before";
      return Verdict::kRefused;
    case Sequence::kWentBack:
      log_.warn(fmt::format("the time went back, to {}: the tracker starts again", stamp_of(frame.header)));
      break;
    case Sequence::kOtherFrameId:
      log_.warn(fmt::format("frame_id changed, to '{}': the tracker starts again", frame.header.frame_id));
      break;
    case Sequence::kFirst:
    case Sequence::kNext:
      break;
  }
  if (judgement.missing > 0) note_missing(frame, judgement.missing, status);
  if (is_in_gap(frame)) {
    refuse(status);
    return Verdict::kRefused;
  }
  if (judgement.verdict == Sequence::kNext) return Verdict::kContinues;
  ++counts_.run;
  has_mesh_ = false;
  return Verdict::kBeginsRun;
}

void FrameAdmission::note_missing(const ReceivedFrame& frame, std::uint64_t missing, TrackerStatus& status) {
  counts_.frames_missing += missing;
  const std::string what = count_missing(missing);
  if (policy_ == QueuePolicy::kStrict) {
    open_gap(frame, fmt::format("{} before {}", what, stamp_of(frame.header)));
    return;
  }
  status.warnings.push_back(what + " before this one");
  log_.warn_sometimes("missing", fmt::format("{} before {}; {} so far. What is lost on the way: raise ~queue_size, and "
                                             "the queue of the publisher",
                                             what, stamp_of(frame.header), counts_.frames_missing));
}

void FrameAdmission::open_gap(const ReceivedFrame& frame, const std::string& what) {
  gap_ = what;
  gap_begin_ = frame.number;
  log_.error(
      fmt::format("a gap in the input: {}. queue_policy is strict: no more frames are tracked until ~reset", gap_));
}

void FrameAdmission::refuse(TrackerStatus& status) const {
  status.state = TrackerStatus::FAILED;
  status.reason = fmt::format("there is a gap in the input: {} (queue_policy is strict; call ~reset)", gap_);
}

void FrameAdmission::conclude(const ReceivedFrame& frame, const TrackerStatus& status) {
  count(frame, status);
  if (policy_ != QueuePolicy::kStrict || is_in_gap(frame)) return;
  // What is not in the mesh is a gap for the next frame, for whatever reason. Before the first mesh it is none, unless
  // the frame that the mesh belongs to is the one that failed. Before one that is ahead the mesh will be there.
  const bool has_mesh = has_mesh_ || frame.is_ahead;
  if (status.state == TrackerStatus::FAILED || (status.state == TrackerStatus::INVALID && has_mesh)) {
    open_gap(frame, fmt::format("the frame of {} could not be tracked ({})", stamp_of(frame.header), status.reason));
  }
}

void FrameAdmission::count(const ReceivedFrame& frame, const TrackerStatus& status) {
  ++counts_.frames_received;
  const std::string stamp = stamp_of(frame.header);
  switch (status.state) {
    case TrackerStatus::STARTED:
      start_ = {to_nanoseconds(frame.header.stamp), checksum_of(*frame.cloud)};
      [[fallthrough]];
    case TrackerStatus::TRACKED:
      ++counts_.frames_tracked;
      has_mesh_ = true;
      break;
    case TrackerStatus::SKIPPED:
      ++counts_.frames_skipped;
      // That a newer one was taken is what was asked for.
      if (frame.reception == Reception::kReplaced || went_on_) break;
      log_.warn_sometimes("skipped", fmt::format("skipped the frame of {}: {}; {} so far", stamp, status.reason,
                                                 counts_.frames_skipped));
      break;
    case TrackerStatus::DROPPED:
      ++counts_.frames_dropped;
      log_.warn_sometimes("dropped",
                          fmt::format("dropped the frame of {}: {}; {} so far. Slow the input down (rosbag play "
                                      "--rate-control-topic), or raise ~queue_size",
                                      stamp, status.reason, counts_.frames_dropped));
      break;
    case TrackerStatus::INVALID:
      ++counts_.frames_invalid;
      log_.warn_sometimes("invalid", fmt::format("cannot use the frame of {}: {}", stamp, status.reason));
      break;
    default:
      ++counts_.frames_failed;
      // With policy strict it is said as a gap, once.
      if (policy_ == QueuePolicy::kStrict) break;
      log_.error_sometimes("failed", fmt::format("cannot track the frame of {}: {}", stamp, status.reason));
  }
}

void FrameAdmission::reset() {
  sequence_.reset();
  has_mesh_ = false;
  went_on_ = false;
  if (gap_begin_ <= last_number_ + 1) {
    gap_.clear();
  } else if (!gap_.empty()) {
    log_.warn("frames from before the gap wait still: the next run has them, and ends at the gap");
  }
}

InputPlace FrameAdmission::place() const {
  return {sequence_, counts_.run, start_};
}

void FrameAdmission::go_on(InputPlace place) {
  reset();
  sequence_ = std::move(place.sequence);
  // As after a reset, where there was a run here before.
  counts_.run = std::max(counts_.run + 1, place.run);
  start_ = place.start;
  has_mesh_ = true;
  went_on_ = true;
}

void FrameAdmission::describe(TrackerStatus& status) const {
  status.run = counts_.run;
  status.frames_received = counts_.frames_received;
  status.frames_tracked = counts_.frames_tracked;
  status.frames_skipped = counts_.frames_skipped;
  status.frames_dropped = counts_.frames_dropped;
  status.frames_invalid = counts_.frames_invalid;
  status.frames_failed = counts_.frames_failed;
  status.frames_missing = counts_.frames_missing;
}

}  // namespace particle_surface_tracker
