// What of the tracking worker is about checkpoints.

#include <future>

#include <fmt/format.h>
#include <boost/make_shared.hpp>

#include "particle_surface_tracker/core/error.h"
#include "ros/live/frame_description.h"
#include "ros/live/tracking_worker.h"
#include "ros/live/waiting_parameters.h"

namespace particle_surface_tracker {

Checkpoint TrackingWorker::checkpoint() {
  Checkpoint checkpoint;
  run_in_turn([&] { checkpoint = state(); });
  return checkpoint;
}

void TrackingWorker::go_on(const Checkpoint& checkpoint) {
  run_in_turn([&] {
    take_over(checkpoint);
    keeper_.note_jump([this] { return state(); });
    update_waiting();
  });
}

void TrackingWorker::run_in_turn(const std::function<void()>& task) {
  const auto result = std::make_shared<std::promise<void>>();
  std::future<void> done = result->get_future();
  queue_.push(FrameQueue::Command([&task, result] {
    try {
      task();
      result->set_value();
    } catch (...) {
      result->set_exception(std::current_exception());
    }
  }));
  done.get();
}

Checkpoint TrackingWorker::state() const {
  if (!handler_.started()) throw TrackingError("nothing is tracked yet; there is no run to keep");
  Checkpoint checkpoint;
  handler_.save(checkpoint);
  checkpoint.sections[input_section] = to_bytes(admission_.place());
  checkpoint.sections[configured_section] = to_bytes(configured_);
  return checkpoint;
}

void TrackingWorker::take_over(const Checkpoint& checkpoint) {
  const auto section = checkpoint.sections.find(input_section);
  if (section == checkpoint.sections.end()) throw InputError("it is no checkpoint of a node, but of track_bag");
  InputPlace place = input_place_from(section->second);
  load(checkpoint);
  admission_.go_on(std::move(place));
  diagnostics_.note_reset();
  outputs_.clear();
  show_mesh();
  update_waiting_parameters();
  log_.info(
      fmt::format("goes on from a checkpoint, after the frame of stamp {}.{:09}: {} vertices, {} triangles. Frames "
                  "up to that one are skipped if they come again; ~reset begins anew",
                  last_mesh_->header.stamp.sec, last_mesh_->header.stamp.nsec, last_mesh_->ids.size(),
                  last_mesh_->triangles.size() / 3));
  const std::string waiting = waiting_parameters();
  if (waiting.empty()) return;
  log_.warn(fmt::format(
      "goes on with the values of the checkpoint; others wait for the next reset (service ~reset): {}", waiting));
}

void TrackingWorker::show_mesh() {
  auto mesh = boost::make_shared<TrackedMesh>(handler_.message(content_));
  auto view =
      std::make_shared<TrackedView>(view_of(handler_.tracker(), FrameReport(), handler_.tracker().mesh().next_id()));
  view->mesh = std::move(mesh);
  last_mesh_ = view->mesh;
  outputs_.publish(std::move(view));
}

}  // namespace particle_surface_tracker
