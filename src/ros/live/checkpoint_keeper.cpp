#include "ros/live/checkpoint_keeper.h"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

namespace particle_surface_tracker {

namespace fs = std::filesystem;

CheckpointKeeper::CheckpointKeeper(CheckpointOptions options, ThrottledLog& log)
    : options_(std::move(options)), log_(log) {}

void CheckpointKeeper::resume(const std::function<void(const Checkpoint&)>& go_on) {
  if (options_.path.empty()) return;
  std::error_code error;
  if (fs::symlink_status(options_.path, error).type() == fs::file_type::not_found) {
    log_.info(fmt::format("there is no checkpoint '{}' yet; the first frame begins a run", options_.path));
    return;
  }
  try {
    go_on(read_checkpoint(options_.path));
  } catch (const std::exception& refusal) {
    set_aside(refusal.what());
  }
}

void CheckpointKeeper::set_aside(const std::string& reason) {
  std::error_code error;
  std::string aside = options_.path + ".refused";
  for (int n = 2; fs::exists(fs::symlink_status(aside, error)); ++n) {
    aside = fmt::format("{}.refused_{}", options_.path, n);
  }
  fs::rename(options_.path, aside, error);
  if (!error) {
    log_.error(fmt::format("checkpoint '{}' is refused: {}; it lies in '{}' now, and the first frame begins a run",
                           options_.path, reason, aside));
    return;
  }
  log_.error(
      fmt::format("checkpoint '{}' is refused: {}; it cannot be set aside ({}), so none is kept in its place, and "
                  "the first frame begins a run",
                  options_.path, reason, error.message()));
  options_.path.clear();
}

void CheckpointKeeper::note_frame(const State& state) {
  if (is_kept() && ++frames_ >= options_.every) write(state);
}

void CheckpointKeeper::note_jump(const State& state) {
  if (is_kept()) write(state);
}

void CheckpointKeeper::finish(const State& state) {
  if (frames_ > 0) write(state);
}

void CheckpointKeeper::forget() {
  frames_ = 0;
  if (!is_kept()) return;
  std::error_code error;
  fs::remove(options_.path, error);
  if (error) {
    log_.error(
        fmt::format("cannot remove '{}', the checkpoint of a run that has ended: {}", options_.path, error.message()));
  }
}

void CheckpointKeeper::write(const State& state) {
  frames_ = 0;
  try {
    write_checkpoint(options_.path, state());
    log_.debug(fmt::format("kept the checkpoint '{}'", options_.path));
  } catch (const std::exception& error) {
    log_.error_sometimes("checkpoint", fmt::format("cannot keep the checkpoint: {}", error.what()));
  }
}

}  // namespace particle_surface_tracker
