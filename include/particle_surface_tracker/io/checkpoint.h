#pragma once

#include <map>
#include <string>

#include "particle_surface_tracker/tracker/tracker_state.h"

namespace particle_surface_tracker {

/// All that a run goes on from after it has ended in whatever way.
struct Checkpoint {
  TrackerState tracker;

  /// What the layers above the tracker keep with it, each under a name of its own, as bytes that only they can read.
  std::map<std::string, std::string> sections;
};

/// Writes a checkpoint so that it appears whole under its name or not at all, also where the power fails: into a
/// temporary file beside it, which is flushed to the disk and renamed. The format is in docs/checkpoints.md.
/// \throw OutputError if it cannot be written; a file that was there before is still there then.
void write_checkpoint(const std::string& path, const Checkpoint& checkpoint);

/// \throw InputError that says why, if the file cannot be read, is no checkpoint, is one of another version, is damaged,
/// or holds what a tracker never leaves behind.
Checkpoint read_checkpoint(const std::string& path);

}  // namespace particle_surface_tracker
