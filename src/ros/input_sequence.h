#pragma once

#include <cstdint>
#include <deque>
#include <string>

#include <std_msgs/Header.h>

#include "particle_surface_tracker/io/byte_stream.h"

namespace particle_surface_tracker {

/// Follows the headers of the input: tells frames that continue a run from those that begin another or come too late,
/// and finds those that are missing.
class InputSequence {
 public:
  enum class Verdict {
    kFirst,        ///< Nothing came before.
    kNext,         ///< Continues the run.
    kRepeated,     ///< Has the stamp of the frame before.
    kLate,         ///< Is older than the frame before.
    kWentBack,     ///< The time went back: begins a new run.
    kOtherFrameId  ///< Has another frame_id: begins a new run.
  };

  struct Judgement {
    Verdict verdict = Verdict::kFirst;
    std::uint64_t index = 0;    ///< Of the frame in its run, those that are missing or cannot be used counted too.
    std::uint64_t missing = 0;  ///< Frames that never arrived, between the frame before and this one.
  };

  /// Judges the frame that arrived next. A stamp that is not above that of the frame before belongs to a new run where
  /// it is below all of the run, or is the third in a row that is late and those three follow each other; else it is
  /// late.
  ///
  /// Frames are missing where sequence numbers jump; where the source does not count, where the time between two stamps
  /// is more than 1.5 times the median of the last ones.
  Judgement judge(const std_msgs::Header& header);

  /// Frames arrived that are not judged: their headers cannot be relied on, or they are not going to be tracked.
  void pass_over(std::uint64_t frames = 1) { passed_over_ += frames; }

  /// The next frame is the first.
  void reset() { *this = InputSequence(); }

  /// Puts all that the next judgement goes by.
  void put(ByteWriter& bytes) const;

  /// Takes what put() has put.
  /// \throw InputError if it is something else.
  static InputSequence take(ByteReader& bytes);

  /// Whether a frame lies within the run so far, from its first stamp to its last.
  bool covers(const std_msgs::Header& header) const;

  /// A frame that the run covers came again, and is not judged. Gaps after the last one are found by its new number.
  void note_again(const std_msgs::Header& header);

 private:
  Judgement begin(const std_msgs::Header& header, Verdict verdict);
  Verdict judge_backward(std::int64_t stamp);
  std::uint64_t count_missing(const std_msgs::Header& header, std::int64_t stamp);

  bool started_ = false;
  std::string frame_id_;
  std::uint64_t index_ = 0;
  std::uint64_t passed_over_ = 0;  // Since the last frame that continued the run.
  std::int64_t first_stamp_ = 0;   // [ns]
  std::int64_t last_stamp_ = 0;    // [ns]
  std::int64_t last_late_stamp_ = 0;
  int late_in_a_row_ = 0;
  std::uint32_t last_number_ = 0;
  bool source_counts_ = false;
  std::deque<std::int64_t> intervals_;  // Between the last stamps [ns].
};

}  // namespace particle_surface_tracker
