// What of the tracking worker is about parameters.

#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "ros/live/tracking_worker.h"
#include "ros/live/waiting_parameters.h"

namespace particle_surface_tracker {

void TrackingWorker::set_parameters(const Parameters& parameters) {
  queue_.push(FrameQueue::Command([this, parameters] {
    try {
      handler_.set_parameters(parameters);
    } catch (const ParameterError& error) {
      log_.warn(fmt::format("refused: {}; all parameters stay as they were", error.what()));
      return;
    }
    wanted_ = parameters;
    update_waiting_parameters();
    const std::string waiting = waiting_parameters();
    if (waiting.empty()) return;
    log_.warn(
        fmt::format("{}: it cannot change while a mesh is being tracked, and waits for the next reset (service "
                    "~reset)",
                    waiting));
  }));
}

void TrackingWorker::load(const Checkpoint& checkpoint) {
  require_not_configured_otherwise(checkpoint, configured_, estimates_spacing_);
  // The handler itself takes no other values than those of the checkpoint. What waits is given to it again after that.
  handler_.set_parameters(with_values_in_force(wanted_, checkpoint.tracker.parameters));
  try {
    handler_.load(checkpoint);
  } catch (...) {
    handler_.set_parameters(wanted_);
    throw;
  }
  handler_.set_parameters(wanted_);
}

std::string TrackingWorker::waiting_parameters() const {
  return handler_.started() ? describe_waiting(handler_.tracker().parameters(), wanted_) : "";
}

void TrackingWorker::update_waiting_parameters() {
  diagnostics_.note_waiting_parameters(waiting_parameters());
}

}  // namespace particle_surface_tracker
