#include "particle_surface_tracker/ros/offline_runner.h"

#include <tbb/global_control.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "frame_reader.h"
#include "particle_attributes.h"
#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/frame_check.h"
#include "particle_surface_tracker/io/mesh_reader.h"
#include "particle_surface_tracker/ros/frame_handler.h"
#include "particle_surface_tracker/ros/particle_bag.h"
#include "run_checkpoint.h"
#include "run_facts.h"
#include "run_input.h"
#include "run_messages.h"
#include "run_outputs.h"
#include "stage_table.h"
#include "stopwatch.h"

namespace particle_surface_tracker {
namespace {

class OfflineRun {
 public:
  OfflineRun(const OfflineOptions& options, std::ostream& out, std::ostream& err)
      : options_(options),
        out_(out),
        messages_(err, /*warnings*/ !options.quiet, options.progress && !options.quiet),
        bag_(options.bag, options.topic),
        frames_(bag_) {
    choose_frames();
    if (options_.resume.empty()) {
      begin();
    } else {
      resume();
    }
    for (const std::string& damage : bag_.damage()) messages_.warn(damage);
  }

  OfflineSummary run(const std::atomic<bool>& stop) {
    const std::uint64_t begin = next_;
    for (; next_ <= last_ && !summary_.interrupted;) {
      const std::uint64_t frame = next_++;
      run_frame(frame);
      summary_.interrupted = stop && frame != last_;
      messages_.show_progress(summary_.tracked + summary_.skipped, last_ - begin + 1, frame,
                              facts_.real_time_factor(elapsed_.seconds()));
      if (checkpoint_due()) save_checkpoint(outputs_->settle());
    }
    messages_.end_progress();
    finish();
    if (!options_.quiet) print_summary();
    return summary_;
  }

 private:
  void choose_frames() {
    const std::string held = fmt::format("the bag has {} frames, 0 to {}", bag_.size(), bag_.size() - 1);
    last_ = options_.last.value_or(bag_.size() - 1);
    if (options_.first >= bag_.size()) throw ParameterError(fmt::format("--first {}: {}", options_.first, held));
    if (last_ >= bag_.size()) throw ParameterError(fmt::format("--last {}: {}", last_, held));
    if (last_ < options_.first) {
      throw ParameterError(fmt::format("--last {} comes before --first {}", last_, options_.first));
    }
  }

  void begin() {
    next_ = options_.first;
    outputs_.emplace(options_, nullptr);
    handler_.emplace(handler_options());
    // One of an older run must not be taken for one of this run.
    std::error_code ignored;
    if (keeps_checkpoints()) std::filesystem::remove(options_.checkpoint, ignored);
  }

  void resume() {
    const Checkpoint checkpoint = read_checkpoint(options_.resume);
    try {
      const RunProgress progress = require_this_run(checkpoint, options_, bag_);
      FrameHandlerOptions handler;
      handler.parameters = checkpoint.tracker.parameters;
      handler_.emplace(std::move(handler));
      handler_->load(checkpoint);
      input_.load(checkpoint);
      next_ = progress.next;
      if (next_ > last_ + 1) {
        throw ParameterError(
            fmt::format("--last {}: the run has got beyond it and goes on with frame {}", last_, next_));
      }
      outputs_.emplace(options_, &progress);
    } catch (const ParameterError& error) {
      throw ParameterError(fmt::format("--resume {}: {}", options_.resume, error.what()));
    } catch (const InputError& error) {
      throw InputError(fmt::format("--resume {}: {}", options_.resume, error.what()));
    }
    if (!options_.quiet) out_ << fmt::format("going on with frame {}\n", next_) << std::flush;
  }

  FrameHandlerOptions handler_options() {
    FrameHandlerOptions handler;
    handler.parameters = options_.parameters;
    handler.estimate_spacing = options_.estimate_spacing;
    handler.refine_mesh = options_.refine_initial;
    if (options_.mesh) {
      LoadedMesh loaded = read_initial_mesh(*options_.mesh);
      for (const std::string& warning : loaded.warnings) {
        messages_.warn(fmt::format("mesh '{}': {}", *options_.mesh, warning));
      }
      handler.mesh = std::move(loaded.mesh);
    }
    return handler;
  }

  void run_frame(std::uint64_t frame) {
    try {
      const Stopwatch reading;
      const sensor_msgs::PointCloud2ConstPtr cloud = frames_.take(frame);
      times_.add("reading the bag", reading.seconds());
      if (options_.pipeline && frame != last_) look_ahead(frame + 1);
      track(frame, cloud);
    } catch (const InputError& error) {
      skip(frame, error);
    } catch (const ParticleError& error) {
      skip(frame, error);
    } catch (const TrackingError& error) {
      throw TrackingError(fmt::format("frame {}: {}", frame, error.what()));
    }
  }

  // The next frame is prepared, and the one after it read, while this one is tracked.
  void look_ahead(std::uint64_t frame) {
    const Stopwatch reading;
    const sensor_msgs::PointCloud2ConstPtr cloud = frames_.look_ahead(frame);
    times_.add("reading the bag", reading.seconds());
    if (frame != last_) frames_.prefetch(frame + 1);
    if (cloud != nullptr) handler_->look_ahead(cloud);
  }

  void track(std::uint64_t frame, const sensor_msgs::PointCloud2ConstPtr& cloud) {
    const bool is_first = !handler_->started();
    handler_->record_topology_cells(outputs_->wants_cells(frame));
    FrameReport report = handler_->handle(*cloud, frame);
    if (is_first && options_.estimate_spacing && !options_.quiet) {
      out_ << fmt::format("particle spacing estimated from frame {}: {:.6g} m\n", frame,
                          handler_->tracker().parameters().particle_spacing)
           << std::flush;
    }
    for (const FrameReport::StageTime& time : report.times) times_.add(time.stage, time.seconds);
    if (options_.check) check(report);
    const std::string trouble = input_.judge(cloud->header, report);
    for (const std::string& warning : report.warnings) messages_.warn(fmt::format("frame {}: {}", frame, warning));
    if (!trouble.empty()) say_once(trouble, report);
    facts_.note(report);
    std::vector<InterpolatedField> fields = interpolated(*cloud, report);
    const Stopwatch writing;
    outputs_->write(frame, cloud, *handler_, report, std::move(fields));
    writing_seconds_ += writing.seconds();
    ++summary_.tracked;
  }

  // What may be true of every frame, said in the first; the report has it in all.
  void say_once(const std::string& text, FrameReport& report) {
    messages_.warn_once(report.frame, text);
    report.warnings.push_back(text);
  }

  std::vector<InterpolatedField> interpolated(const sensor_msgs::PointCloud2& cloud, FrameReport& report) {
    if (options_.interpolate.empty()) return {};
    const Stopwatch interpolating;
    const ParticleAttributes attributes = read_particle_attributes(cloud, options_.interpolate);
    for (const std::string& missing : attributes.missing) say_once(missing, report);
    const Tracker& tracker = handler_->tracker();
    auto fields = interpolate(attributes, tracker.mesh().positions(), tracker.parameters().particle_spacing);
    times_.add("interpolation", interpolating.seconds());
    return fields;
  }

  // Before anything is written, so that no broken mesh gets out.
  void check(FrameReport& report) {
    const Stopwatch checking;
    check_frame(handler_->tracker().mesh(), report);
    times_.add("checking", checking.seconds());
  }

  bool keeps_checkpoints() const { return !options_.checkpoint.empty(); }

  bool checkpoint_due() const {
    return keeps_checkpoints() &&
           ((next_ - options_.first) % options_.checkpoint_every == 0 || next_ == last_ + 1 || summary_.interrupted);
  }

  void save_checkpoint(const OutputProgress& outputs) {
    const Stopwatch saving;
    Checkpoint checkpoint;
    handler_->save(checkpoint);
    input_.save(checkpoint);
    checkpoint.sections[run_section] = to_bytes(RunProgress{options_.first, next_, options_.interpolate, outputs});
    write_checkpoint(options_.checkpoint, checkpoint);
    times_.add("checkpoints", saving.seconds());
  }

  void finish() {
    if (summary_.interrupted && keeps_checkpoints()) return;
    const OutputProgress outputs = outputs_->finish();
    // Before the parts of a bag go, no checkpoint may refer to them any more.
    if (keeps_checkpoints() && outputs.bag) save_checkpoint(outputs);
    outputs_->clean_up();
    if (options_.resume.empty()) warn_of_leftovers();
  }

  void warn_of_leftovers() {
    for (const auto& [folder, count] : outputs_->leftovers()) {
      messages_.warn(fmt::format("'{}' also holds {} frame{} of another run; remove {} or choose another folder",
                                 folder, count, count == 1 ? "" : "s", count == 1 ? "it" : "them"));
    }
  }

  template <typename Reason>
  void skip(std::uint64_t frame, const Reason& reason) {
    input_.pass_over();
    outputs_->write_error(frame, reason.what());
    if (!handler_->started()) {
      // The mesh belongs to this frame and no other, so there is nothing to go on with.
      throw Reason(fmt::format("frame {}: {} (--first begins at another frame)", frame, reason.what()));
    }
    messages_.warn(fmt::format("frame {} skipped: {}", frame, reason.what()));
    ++summary_.skipped;
  }

  void print_summary() {
    times_.add("writing", writing_seconds_);
    times_.print(out_, summary_.tracked);
    const double elapsed = elapsed_.seconds();
    const std::optional<double> factor = facts_.real_time_factor(elapsed);
    out_ << fmt::format(
        "{} frames tracked in {:.1f} s ({:.2f} frames/s{}), {:.1f} s of processor time, {:.0f} MB of memory\n",
        summary_.tracked, elapsed, static_cast<double>(summary_.tracked) / elapsed,
        factor ? fmt::format(", {:.2g} x real time", *factor) : "", process_cpu_seconds(),
        1e-6 * static_cast<double>(process_peak_memory()));
    facts_.print(out_);
    if (options_.check && summary_.tracked != 0) {
      out_ << fmt::format("checked: all {} meshes are closed, manifold and oriented\n", summary_.tracked);
    }
    if (summary_.skipped != 0) out_ << fmt::format("{} frames skipped\n", summary_.skipped);
    if (summary_.interrupted) out_ << "interrupted; what was written so far is complete\n";
    if (summary_.interrupted && keeps_checkpoints()) {
      out_ << fmt::format("--resume {} goes on with frame {}\n", options_.checkpoint, next_);
    }
    print_places();
    out_ << std::flush;
  }

  void print_places() {
    std::vector<std::string> places;
    for (const std::string& place : {options_.format || !options_.debug_cells.empty() ? options_.out : std::string(),
                                     options_.surface, options_.vdb, options_.out_bag, options_.report}) {
      if (!place.empty()) places.push_back(place);
    }
    if (!places.empty()) out_ << fmt::format("written: {}\n", fmt::join(places, ", "));
  }

  const OfflineOptions& options_;
  std::ostream& out_;
  Stopwatch elapsed_;
  RunMessages messages_;
  ParticleBag bag_;
  FrameReader frames_;
  std::uint64_t next_ = 0;
  std::uint64_t last_ = 0;
  std::optional<RunOutputs> outputs_;
  std::optional<FrameHandler> handler_;
  RunInput input_;
  RunFacts facts_;
  StageTable times_;
  double writing_seconds_ = 0.0;  // Kept apart to stand last in the table.
  OfflineSummary summary_;
};

}  // namespace

OfflineSummary run_offline(const OfflineOptions& options, const std::atomic<bool>& stop, std::ostream& out,
                           std::ostream& err) {
  std::optional<tbb::global_control> limit;
  if (options.threads) limit.emplace(tbb::global_control::max_allowed_parallelism, *options.threads);
  return OfflineRun(options, out, err).run(stop);
}

}  // namespace particle_surface_tracker
