#include "particle_surface_tracker/stages/detection.h"

#include <algorithm>

#include "triangle_cells.h"

namespace particle_surface_tracker {

namespace {

/// Cells of Γ that the triangles of the marked vertices meet.
std::vector<openvdb::Coord> cells_of_triangles(const TriangleMesh& mesh, const std::vector<bool>& marked, double h) {
  std::vector<openvdb::Coord> cells;
  for (const Triangle& triangle : mesh.triangles()) {
    if (!marked[triangle[0]] && !marked[triangle[1]] && !marked[triangle[2]]) continue;
    append_triangle_cells({mesh.positions()[triangle[0]].cast<double>(), mesh.positions()[triangle[1]].cast<double>(),
                           mesh.positions()[triangle[2]].cast<double>()},
                          h, cells);
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

}  // namespace

Detection apply_projection(TriangleMesh& mesh, const Projection& projection, const Parameters& parameters) {
  Detection detection;
  const double tau = parameters.tau * parameters.particle_spacing;
  std::vector<bool> flagged(mesh.vertex_count(), false);
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const bool found = projection.status[v] == ProjectionStatus::kFound;
    const double moved = (projection.positions[v].cast<double>() - mesh.positions()[v].cast<double>()).norm();
    if (found && moved <= tau) {
      mesh.positions()[v] = projection.positions[v];
      continue;
    }
    flagged[v] = true;
    detection.flagged_vertices.push_back(v);
    if (!found) ++detection.unreached_vertices;
  }
  if (!detection.flagged_vertices.empty()) {
    detection.flagged_cells = cells_of_triangles(mesh, flagged, parameters.dx_gamma * parameters.particle_spacing);
  }
  return detection;
}

}  // namespace particle_surface_tracker
