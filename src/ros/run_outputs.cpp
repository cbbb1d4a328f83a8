#include "run_outputs.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/ros/mesh_conversion.h"
#include "particle_surface_tracker/ros/time_conversion.h"

namespace particle_surface_tracker {
namespace {

[[noreturn]] void throw_begun_late(const char* option) {
  throw ParameterError(fmt::format(
      "{}: the run of the checkpoint was without, so it would lack the frames before; leave it out", option));
}

}  // namespace

RunOutputs::RunOutputs(const OfflineOptions& options, const RunProgress* from) : cell_frames_(options.debug_cells) {
  const OutputProgress* progress = from == nullptr ? nullptr : &from->outputs;
  if (options.format) open_meshes(options, from);
  if (!options.surface.empty()) surfaces_.emplace(options.surface, MeshFormat::kPly);
  if (!options.vdb.empty()) fields_.emplace(options.vdb);
  if (!cell_frames_.empty()) cells_.emplace(options.out);
  if (!options.report.empty()) open_report(options, progress);
  if (!options.out_bag.empty()) open_bag(options, progress);
}

void RunOutputs::open_meshes(const OfflineOptions& options, const RunProgress* from) {
  if (from == nullptr) {
    meshes_.emplace(options.out, *options.format);
  } else {
    meshes_.emplace(options.out, *options.format, from->next);
  }
}

void RunOutputs::open_report(const OfflineOptions& options, const OutputProgress* from) {
  if (from == nullptr) {
    report_.emplace(options.report);
  } else if (from->report_bytes) {
    report_.emplace(options.report, *from->report_bytes);
  } else {
    throw_begun_late("--report");
  }
}

void RunOutputs::open_bag(const OfflineOptions& options, const OutputProgress* from) {
  std::error_code not_there;
  if (std::filesystem::equivalent(options.out_bag, options.bag, not_there)) {
    throw ParameterError("--out-bag and --bag are the same file");
  }
  if (from != nullptr && !from->bag) throw_begun_late("--out-bag");
  if (from != nullptr) {
    parts_.emplace(options.out_bag, options.topic, *from->bag);
  } else if (!options.checkpoint.empty()) {
    parts_.emplace(options.out_bag, options.topic, BagProgress());
  } else {
    bag_.emplace(options.out_bag, options.topic);
  }
}

bool RunOutputs::wants_cells(std::uint64_t frame) const {
  return std::any_of(cell_frames_.begin(), cell_frames_.end(),
                     [frame](const auto& range) { return range.first <= frame && frame <= range.second; });
}

void RunOutputs::write(std::uint64_t frame, const sensor_msgs::PointCloud2ConstPtr& cloud, const FrameHandler& handler,
                       const FrameReport& report, std::vector<InterpolatedField> interpolated) {
  const std::int64_t stamp = to_nanoseconds(cloud->header.stamp);
  const bool has_fields = !interpolated.empty();
  TrackedMesh message;
  if (has_fields || bag_ || parts_) {
    message = handler.message();
    message.interpolated = std::move(interpolated);
  }
  if (meshes_) meshes_->write(has_fields ? to_mesh_with_fields(message) : handler.tracker().mesh(), frame, stamp);
  if (surfaces_) {
    const SurfaceTriangulation& surface = handler.tracker().implicit_surface()->triangulation;
    surfaces_->write(TriangleMesh(surface.vertices, surface.triangles), frame, stamp);
  }
  if (fields_) fields_->write(*handler.tracker().implicit_surface(), frame);
  if (wants_cells(frame)) cells_->write(*handler.tracker().topology_cells(), frame);
  if (bag_) bag_->write(cloud, message);
  if (parts_) parts_->write(cloud, message);
  if (report_) report_->write(report);
}

void RunOutputs::write_error(std::uint64_t frame, const std::string& error) {
  if (report_) report_->write_error(frame, error);
}

OutputProgress RunOutputs::settle() {
  OutputProgress progress;
  if (report_) progress.report_bytes = report_->bytes();
  if (parts_) progress.bag = parts_->end_part();
  return progress;
}

OutputProgress RunOutputs::finish() {
  OutputProgress progress = settle();
  if (bag_) bag_->close();
  if (parts_) progress.bag = parts_->join();
  return progress;
}

std::vector<std::pair<std::string, std::size_t>> RunOutputs::leftovers() const {
  std::vector<std::pair<std::string, std::size_t>> result;
  for (const auto* meshes : {&meshes_, &surfaces_}) {
    const std::size_t count = *meshes ? (*meshes)->count_of_others() : 0;
    if (count != 0) result.emplace_back((*meshes)->folder(), count);
  }
  return result;
}

void RunOutputs::clean_up() {
  if (parts_) parts_->remove_parts();
}

}  // namespace particle_surface_tracker
