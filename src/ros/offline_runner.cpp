#include "particle_surface_tracker/ros/offline_runner.h"

#include <tbb/global_control.h>

#include <chrono>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/frame_check.h"
#include "particle_surface_tracker/io/mesh_reader.h"
#include "particle_surface_tracker/io/report_writer.h"
#include "particle_surface_tracker/io/vdb_sequence.h"
#include "particle_surface_tracker/ros/frame_handler.h"
#include "particle_surface_tracker/ros/particle_bag.h"
#include "particle_surface_tracker/ros/tracking_bag_writer.h"
#include "run_messages.h"
#include "stage_table.h"

namespace particle_surface_tracker {
namespace {

class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class OfflineRun {
 public:
  OfflineRun(const OfflineOptions& options, std::ostream& out, std::ostream& err)
      : options_(options),
        out_(out),
        messages_(err, /*warnings*/ !options.quiet, options.progress && !options.quiet),
        bag_(options.bag, options.topic) {
    choose_frames();
    open_outputs();
    handler_.emplace(handler_options());
    for (const std::string& damage : bag_.damage()) messages_.warn(damage);
  }

  OfflineSummary run(const std::atomic<bool>& stop) {
    for (std::uint64_t frame = options_.first; frame <= last_ && !summary_.interrupted; ++frame) {
      run_frame(frame);
      summary_.interrupted = stop && frame != last_;
      messages_.show_progress(summary_.tracked + summary_.skipped, last_ - options_.first + 1, frame);
    }
    messages_.end_progress();
    if (out_bag_) out_bag_->close();
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

  // Whatever cannot be written is found out before any work is done.
  void open_outputs() {
    meshes_.emplace(options_.out, options_.format);
    if (!options_.surface.empty()) surfaces_.emplace(options_.surface, MeshFormat::kPly);
    if (!options_.vdb.empty()) fields_.emplace(options_.vdb);
    if (!options_.report.empty()) report_.emplace(options_.report);
    if (options_.out_bag.empty()) return;
    std::error_code not_there;
    if (std::filesystem::equivalent(options_.out_bag, options_.bag, not_there)) {
      throw ParameterError("--out-bag and --bag are the same file");
    }
    out_bag_.emplace(options_.out_bag, options_.topic);
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
      const sensor_msgs::PointCloud2ConstPtr cloud = bag_.read(frame);
      times_.add("reading the bag", reading.seconds());
      track(frame, cloud);
    } catch (const InputError& error) {
      skip(frame, error);
    } catch (const ParticleError& error) {
      skip(frame, error);
    } catch (const TrackingError& error) {
      throw TrackingError(fmt::format("frame {}: {}", frame, error.what()));
    }
  }

  void track(std::uint64_t frame, const sensor_msgs::PointCloud2ConstPtr& cloud) {
    const bool is_first = !handler_->started();
    FrameReport report = handler_->handle(*cloud, frame);
    if (is_first && options_.estimate_spacing && !options_.quiet) {
      out_ << fmt::format("particle spacing estimated from frame {}: {:.6g} m\n", frame,
                          handler_->tracker().parameters().particle_spacing)
           << std::flush;
    }
    for (const FrameReport::StageTime& time : report.times) times_.add(time.stage, time.seconds);
    if (options_.check) check(report);
    for (const std::string& warning : report.warnings) messages_.warn(fmt::format("frame {}: {}", frame, warning));
    const Stopwatch writing;
    write(frame, cloud, report);
    writing_seconds_ += writing.seconds();
    ++summary_.tracked;
  }

  // Before anything is written, so that no broken mesh gets out.
  void check(FrameReport& report) {
    const Stopwatch checking;
    check_frame(handler_->tracker().mesh(), report);
    times_.add("checking", checking.seconds());
  }

  void write(std::uint64_t frame, const sensor_msgs::PointCloud2ConstPtr& cloud, const FrameReport& report) {
    meshes_->write(handler_->tracker().mesh(), frame);
    if (surfaces_) {
      const SurfaceTriangulation& surface = handler_->tracker().implicit_surface()->triangulation;
      surfaces_->write(TriangleMesh(surface.vertices, surface.triangles), frame);
    }
    if (fields_) fields_->write(*handler_->tracker().implicit_surface(), frame);
    if (out_bag_) out_bag_->write(cloud, handler_->message());
    if (report_) report_->write(report);
  }

  template <typename Reason>
  void skip(std::uint64_t frame, const Reason& reason) {
    if (report_) report_->write_error(frame, reason.what());
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
    out_ << fmt::format(
        "{} frames tracked in {:.1f} s ({:.2f} frames/s), {:.1f} s of processor time, {:.0f} MB of memory\n",
        summary_.tracked, elapsed, static_cast<double>(summary_.tracked) / elapsed, process_cpu_seconds(),
        1e-6 * static_cast<double>(process_peak_memory()));
    if (summary_.skipped != 0) out_ << fmt::format("{} frames skipped\n", summary_.skipped);
    if (summary_.interrupted) out_ << "interrupted; what was written so far is complete\n";
    out_ << std::flush;
  }

  const OfflineOptions& options_;
  std::ostream& out_;
  Stopwatch elapsed_;
  RunMessages messages_;
  ParticleBag bag_;
  std::uint64_t last_ = 0;
  std::optional<MeshSequence> meshes_;
  std::optional<MeshSequence> surfaces_;
  std::optional<VdbSequence> fields_;
  std::optional<ReportWriter> report_;
  std::optional<TrackingBagWriter> out_bag_;
  std::optional<FrameHandler> handler_;
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
