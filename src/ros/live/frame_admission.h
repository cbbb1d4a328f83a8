#pragma once

#include <cstdint>
#include <string>

#include <particle_surface_tracker/TrackerStatus.h>

#include "ros/input_sequence.h"
#include "ros/live/frame_queue.h"
#include "ros/live/input_place.h"
#include "ros/live/throttled_log.h"

namespace particle_surface_tracker {

/// Decides which of the frames that arrived are tracked, says in status and log why the others are not, and counts all.
class FrameAdmission {
 public:
  /// \param log outlives this object.
  FrameAdmission(QueuePolicy policy, ThrottledLog& log) : policy_(policy), log_(log) {}

  enum class Verdict {
    kRefused,    ///< Not to be tracked; the status says why.
    kBeginsRun,  ///< The tracker starts anew with it.
    kContinues
  };

  /// Looks at the next frame.
  Verdict judge(const ReceivedFrame& frame, TrackerStatus& status);

  /// Takes note of what became of it in the end, whether it was tracked or not.
  void conclude(const ReceivedFrame& frame, const TrackerStatus& status);

  /// The next frame is the first of a run; a gap is forgiven, unless frames that came before it still wait: it will be
  /// one of the new run.
  void reset();

  /// The counts so far.
  void describe(TrackerStatus& status) const;

  /// How far the run has got: what a checkpoint keeps of it.
  InputPlace place() const;

  /// Goes on with the run of a checkpoint. Frames of it that come again are skipped, until the first new one.
  void go_on(InputPlace place);

 private:
  // Whether it is a frame that the run has tracked before its checkpoint. One that begins like the run, but with other
  // particles, begins another.
  bool came_before(const ReceivedFrame& frame);
  Verdict judge_header(const ReceivedFrame& frame, TrackerStatus& status);
  void note_missing(const ReceivedFrame& frame, std::uint64_t missing, TrackerStatus& status);
  void refuse(TrackerStatus& status) const;
  // From a frame on.
  void open_gap(const ReceivedFrame& frame, const std::string& what);
  bool is_in_gap(const ReceivedFrame& frame) const { return !gap_.empty() && frame.number >= gap_begin_; }
  // Those that are ahead are counted in the sequence where they would have stood.
  void pass_over_those_ahead(const ReceivedFrame& frame);
  void count(const ReceivedFrame& frame, const TrackerStatus& status);

  QueuePolicy policy_;
  ThrottledLog& log_;
  InputSequence sequence_;
  TrackerStatus counts_;   // Only its counters are used.
  bool has_mesh_ = false;  // A frame of this run was tracked.
  InputPlace::Start start_;
  bool went_on_ = false;           // From a checkpoint; no new frame has come since.
  std::string gap_;                // Of policy strict: what was lost first, in words; empty as long as nothing was.
  std::uint64_t gap_begin_ = 0;    // Number of the frame that it begins with, which may be ahead.
  std::uint64_t last_number_ = 0;  // Of the last frame that was not ahead.
};

}  // namespace particle_surface_tracker
