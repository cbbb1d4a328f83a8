#include "particle_surface_tracker/io/report_writer.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "file_descriptor.h"
#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string decimal_seconds(std::int64_t nanoseconds) {
  const bool negative = nanoseconds < 0;
  const std::uint64_t magnitude =
      negative ? 0 - static_cast<std::uint64_t>(nanoseconds) : static_cast<std::uint64_t>(nanoseconds);
  return fmt::format("{}{}.{:09}", negative ? "-" : "", magnitude / 1000000000u, magnitude % 1000000000u);
}

Json times_of(const FrameReport& report) {
  Json times = Json::object();
  for (const FrameReport::StageTime& time : report.times) times[time.stage] = time.seconds;
  times["total"] = report.total_time;
  return times;
}

Json cpu_times_of(const FrameReport& report) {
  Json times = Json::object();
  for (const FrameReport::StageTime& time : report.times) times[time.stage] = time.cpu_seconds;
  return times;
}

Json topology_of(const FrameReport::Topology& topology) {
  return {{"disagreeing_nodes", topology.disagreeing_nodes},
          {"uncovered_particles", topology.uncovered_particles},
          {"conflicting_nodes", topology.conflicting_nodes},
          {"passes", topology.passes},
          {"unknowns", topology.unknowns},
          {"iterations", topology.iterations},
          {"enlargements", topology.enlargements},
          {"changed_nodes", topology.changed_nodes},
          {"complex", topology.complex_cells},
          {"tangled", topology.tangled_cells},
          {"deep", topology.deep_cells},
          {"marked_by_growth", topology.marked_by_growth},
          {"remeshed_cells", topology.remeshed_cells},
          {"removed_components", topology.removed_components},
          {"new_vertices", topology.new_vertices},
          {"retries", topology.retries},
          {"fallbacks", topology.fallbacks},
          {"splits", topology.splits},
          {"merges", topology.merges},
          {"gone", topology.gone}};
}

Json upkeep_of(const FrameReport::Upkeep& upkeep) {
  return {{"splits", upkeep.splits},   {"collapses", upkeep.collapses}, {"flips", upkeep.flips},
          {"tangles", upkeep.tangles}, {"untangled", upkeep.untangled}, {"refused", upkeep.refused}};
}

Json body_of(const FrameReport& report) {
  Json json;
  json["missing_frames"] = report.missing_frames;
  json["particles"] = report.particles;
  json["vertices"] = report.vertices;
  json["triangles"] = report.triangles;
  json["components"] = report.components;
  json["genus"] = report.genus;
  json["volume"] = report.volume;
  json["implicit_volume"] = report.implicit_volume;
  json["area"] = report.area;
  json["max_abs_delta"] = report.max_abs_delta;
  json["smallest_angle"] = report.smallest_angle;
  json["flagged_vertices"] = report.flagged_vertices;
  json["original_vertices_alive"] = report.original_vertices_alive;
  json["times"] = times_of(report);
  json["cpu_seconds"] = report.cpu_seconds;
  json["cpu_times"] = cpu_times_of(report);
  json["peak_rss_bytes"] = report.peak_rss_bytes;
  json["particles_born"] = report.particles_born;
  json["particles_gone"] = report.particles_gone;
  json["flagged_cells"] = report.flagged_cells;
  json["unreached_vertices"] = report.unreached_vertices;
  json["topology"] = topology_of(report.topology);
  json["upkeep"] = upkeep_of(report.upkeep);
  if (report.self_intersecting_triangles) json["self_intersecting_triangles"] = *report.self_intersecting_triangles;
  json["warnings"] = report.warnings;
  return json;
}

std::unique_ptr<FileDescriptor> open_or_throw(const std::string& path, int flags) {
  auto file = std::make_unique<FileDescriptor>(::open(path.c_str(), flags | O_CLOEXEC, 0666));
  if (!file->is_open()) throw OutputError(fmt::format("cannot write report '{}': {}", path, std::strerror(errno)));
  return file;
}

}  // namespace

std::string report_line(const FrameReport& report) {
  // The stamp is put in by hand: the JSON library knows no decimal numbers, only doubles.
  return fmt::format("{{\"frame\":{},\"stamp\":{},{}", report.frame, decimal_seconds(report.stamp_ns),
                     text_of(body_of(report)).substr(1));
}

std::string report_error_line(std::uint64_t frame, const std::string& error) {
  return text_of(Json{{"frame", frame}, {"error", error}});
}

ReportWriter::ReportWriter(std::string path) : path_(std::move(path)) {
  file_ = open_or_throw(path_, O_WRONLY | O_CREAT | O_TRUNC);
}

ReportWriter::ReportWriter(std::string path, std::uint64_t kept_bytes) : path_(std::move(path)), bytes_(kept_bytes) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path_, error);
  if (error) throw InputError(fmt::format("cannot go on with report '{}': {}", path_, error.message()));
  if (size < kept_bytes) {
    throw InputError(fmt::format("cannot go on with report '{}': it has {} bytes, and that of the run had {}", path_,
                                 size, kept_bytes));
  }
  file_ = open_or_throw(path_, O_WRONLY);
  const auto end = static_cast<off_t>(kept_bytes);
  if (::ftruncate(file_->number(), end) != 0 || ::lseek(file_->number(), 0, SEEK_END) != end) {
    throw OutputError(fmt::format("cannot write report '{}': {}", path_, std::strerror(errno)));
  }
}

ReportWriter::~ReportWriter() = default;

void ReportWriter::write(const FrameReport& report) {
  write_line(report_line(report));
}

void ReportWriter::write_error(std::uint64_t frame, const std::string& error) {
  write_line(report_error_line(frame, error));
}

void ReportWriter::write_line(std::string line) {
  line += '\n';
  if (!write_all(file_->number(), line)) {
    throw OutputError(fmt::format("cannot write to report '{}': {}", path_, std::strerror(errno)));
  }
  bytes_ += line.size();
}

}  // namespace particle_surface_tracker
