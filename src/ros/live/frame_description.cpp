#include "ros/live/frame_description.h"

#include <algorithm>
#include <cmath>

namespace particle_surface_tracker {
namespace {

/// Cells of Γ in which re-meshing made vertices that are still there.
std::vector<openvdb::Coord> remeshed_cells(const TriangleMesh& mesh, std::uint32_t first_new_id,
                                           std::size_t new_vertices, double cell_size) {
  std::vector<openvdb::Coord> cells;
  const auto cell_of = [cell_size](float x) { return static_cast<int>(std::floor(x / cell_size)); };
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const std::uint32_t id = mesh.ids()[v];
    if (id < first_new_id || id - first_new_id >= new_vertices) continue;
    const Vec3f& place = mesh.positions()[v];
    cells.emplace_back(cell_of(place.x()), cell_of(place.y()), cell_of(place.z()));
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

}  // namespace

void describe(const FrameReport& report, TrackerStatus& status) {
  status.warnings.insert(status.warnings.end(), report.warnings.begin(), report.warnings.end());
  status.tracking_time = report.total_time;
  status.particles = static_cast<std::uint32_t>(report.particles);
  status.vertices = static_cast<std::uint32_t>(report.vertices);
  status.triangles = static_cast<std::uint32_t>(report.triangles);
  status.components = static_cast<std::uint32_t>(report.components);
  status.flagged_vertices = static_cast<std::uint32_t>(report.flagged_vertices);
  status.flagged_cells = static_cast<std::uint32_t>(report.flagged_cells);
  status.original_vertices = static_cast<std::uint32_t>(report.original_vertices_alive);
  status.remeshed_cells = static_cast<std::uint32_t>(report.topology.remeshed_cells);
  status.splits = static_cast<std::uint32_t>(report.topology.splits);
  status.merges = static_cast<std::uint32_t>(report.topology.merges);
  status.volume = report.volume;
  status.implicit_volume = report.implicit_volume;
}

TrackedView view_of(const Tracker& tracker, const FrameReport& report, std::uint32_t first_new_id) {
  TrackedView view;
  view.surface = tracker.implicit_surface();
  view.r = tracker.parameters().particle_spacing;
  view.cell_size = tracker.parameters().dx_gamma * view.r;
  view.flagged_cells = tracker.detection().flagged_cells;
  view.remeshed_cells = remeshed_cells(tracker.mesh(), first_new_id, report.topology.new_vertices, view.cell_size);
  view.cells = tracker.topology_cells();
  return view;
}

}  // namespace particle_surface_tracker
