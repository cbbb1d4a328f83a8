#include "particle_surface_tracker/io/report_writer.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

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
          {"fallbacks", topology.fallbacks}};
}

Json upkeep_of(const FrameReport::Upkeep& upkeep) {
  return {{"splits", upkeep.splits},   {"collapses", upkeep.collapses}, {"flips", upkeep.flips},
          {"tangles", upkeep.tangles}, {"untangled", upkeep.untangled}, {"refused", upkeep.refused}};
}

Json body_of(const FrameReport& report) {
  Json json;
  json["particles"] = report.particles;
  json["vertices"] = report.vertices;
  json["triangles"] = report.triangles;
  json["components"] = report.components;
  json["genus"] = report.genus;
  json["volume"] = report.volume;
  json["implicit_volume"] = report.implicit_volume;
  json["area"] = report.area;
  json["max_abs_delta"] = report.max_abs_delta;
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

}  // namespace

std::string report_line(const FrameReport& report) {
  // The stamp is put in by hand: the JSON library knows no decimal numbers, only doubles.
  return fmt::format("{{\"frame\":{},\"stamp\":{},{}", report.frame, decimal_seconds(report.stamp_ns),
                     text_of(body_of(report)).substr(1));
}

std::string report_error_line(std::uint64_t frame, const std::string& error) {
  return text_of(Json{{"frame", frame}, {"error", error}});
}

ReportWriter::ReportWriter(std::string path) : path_(std::move(path)), file_(path_, std::ios::trunc) {
  if (!file_) throw OutputError(fmt::format("cannot write report '{}': {}", path_, std::strerror(errno)));
}

void ReportWriter::write(const FrameReport& report) {
  write_line(report_line(report));
}

void ReportWriter::write_error(std::uint64_t frame, const std::string& error) {
  write_line(report_error_line(frame, error));
}

void ReportWriter::write_line(const std::string& line) {
  file_ << line << '\n' << std::flush;
  if (!file_) throw OutputError(fmt::format("cannot write to report '{}': {}", path_, std::strerror(errno)));
}

}  // namespace particle_surface_tracker
