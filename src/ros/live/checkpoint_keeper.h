#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "particle_surface_tracker/io/checkpoint.h"
#include "ros/live/throttled_log.h"

namespace particle_surface_tracker {

/// What private parameters say about checkpoints.
struct CheckpointOptions {
  std::string path;         ///< File that a node goes on from; empty: none.
  std::uint64_t every = 0;  ///< Frames from one checkpoint to the next; 0: none is kept by itself.
};

/// Keeps the state of the live run in a file, so that a node that has died goes on when it comes up again. What fails
/// is said in the log; it ends nothing.
class CheckpointKeeper {
 public:
  using State = std::function<Checkpoint()>;

  /// \param log outlives this object.
  CheckpointKeeper(CheckpointOptions options, ThrottledLog& log);

  /// Goes on from the file, if there is one. A file that is refused, for whatever reason, is set aside under another
  /// name, so that nothing is overwritten that somebody may still want to look at.
  /// \param go_on takes the checkpoint over, or throws and changes nothing.
  void resume(const std::function<void(const Checkpoint&)>& go_on);

  /// A frame was tracked: keeps a checkpoint, if there are enough frames since the last.
  void note_frame(const State& state);

  /// The run is another one, which was not begun here: keeps a checkpoint of it.
  void note_jump(const State& state);

  /// Keeps one if there are frames since the last.
  void finish(const State& state);

  /// The run has ended: a node that comes up now begins another.
  void forget();

 private:
  bool is_kept() const { return !options_.path.empty() && options_.every > 0; }
  void set_aside(const std::string& reason);
  void write(const State& state);

  CheckpointOptions options_;
  ThrottledLog& log_;
  std::uint64_t frames_ = 0;  // Since the last checkpoint.
};

}  // namespace particle_surface_tracker
