#pragma once

#include <string>

#include <std_msgs/Header.h>

#include "input_sequence.h"
#include "particle_surface_tracker/core/frame_report.h"
#include "particle_surface_tracker/io/checkpoint.h"

namespace particle_surface_tracker {

/// What the headers of a bag say of its frames: which are missing, and where the time does not go on. A live node goes
/// by the same judgement; here every frame is tracked whatever it says, as a bag is what its user wants tracked.
class RunInput {
 public:
  /// Puts into a report how many frames are missing before this one.
  /// \return what is wrong with its header, in words; empty if nothing is.
  std::string judge(const std_msgs::Header& header, FrameReport& report);

  /// A frame was skipped; it is not missing.
  void pass_over() { sequence_.pass_over(); }

  /// Puts into a checkpoint what the next judgement goes by.
  void save(Checkpoint& checkpoint) const;

  /// Takes it back; begins afresh where the checkpoint has nothing of it.
  /// \throw InputError if it is damaged.
  void load(const Checkpoint& checkpoint);

 private:
  InputSequence sequence_;
};

}  // namespace particle_surface_tracker
