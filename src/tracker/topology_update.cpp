#include "topology_update.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "band.h"
#include "particle_surface_tracker/stages/disagreement.h"
#include "particle_surface_tracker/stages/mesh_lattice.h"
#include "particle_surface_tracker/stages/remeshing.h"
#include "particle_surface_tracker/stages/topology_matching.h"
#include "stages/matching/field_at_nodes.h"

namespace particle_surface_tracker {

namespace {

using Cells = std::vector<openvdb::Coord>;

Cells united(const Cells& a, const Cells& b) {
  Cells all;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  return all;
}

/// Tells liquid from air at nodes of Γ. Prepared when it is first asked, which few frames do.
class LiquidAtNodes {
 public:
  LiquidAtNodes(const ImplicitSurface& surface, double h) : surface_(surface), h_(h) {}

  bool operator()(const openvdb::Coord& node) {
    if (!field_) field_.emplace(surface_, h_);
    return field_->distances({node}, h_).front() < 0.0f;
  }

 private:
  const ImplicitSurface& surface_;
  double h_;
  std::optional<FieldAtNodes> field_;
};

void describe(const MatchedVoxelization& matched, FrameReport::Topology& topology) {
  topology.unknowns = matched.statistics.unknowns;
  topology.iterations = static_cast<std::size_t>(matched.statistics.iterations);
  topology.enlargements = static_cast<std::size_t>(matched.statistics.enlargements);
  topology.changed_nodes = matched.changed.size();
}

void describe(const RemeshingReport& remeshed, FrameReport& report) {
  FrameReport::Topology& topology = report.topology;
  topology.complex_cells = remeshed.complex_cells;
  topology.tangled_cells = remeshed.tangled_cells;
  topology.deep_cells = remeshed.deep_cells;
  topology.marked_by_growth = remeshed.marked_by_growth;
  topology.remeshed_cells = remeshed.remeshed_cells;
  topology.removed_components = remeshed.removed_components;
  topology.new_vertices = remeshed.new_vertices;
  topology.retries = remeshed.retries;
  topology.fallbacks = remeshed.fallbacks;
  if (remeshed.gave_up) {
    report.warnings.push_back("the mesh could not be re-meshed soundly; its topology stays as it was");
  }
}

/// Measures δ of some vertices where they are (Sec. 5.2), by the search that projects.
/// \return the largest |δ| of them [m].
double measure_delta_of(TriangleMesh& mesh, const std::vector<std::uint32_t>& vertices, const ImplicitSurface& surface,
                      const Parameters& parameters, FrameReport& report, StageTimer& timer) {
  if (vertices.empty()) return 0.0;
  std::vector<Vec3f> positions;
  positions.reserve(vertices.size());
  for (const std::uint32_t v : vertices) positions.push_back(mesh.positions()[v]);
  const double r = parameters.particle_spacing;
  const Projection measured = project_within_band(positions, std::vector<float>(positions.size(), 0.0f), surface,
                                                  parameters.tau * r, parameters.max_reach * r, parameters, timer);
  double largest = 0.0;
  std::size_t lost = 0;
  for (std::size_t n = 0; n < vertices.size(); ++n) {
    const bool found = measured.status[n] == ProjectionStatus::kFound;
    mesh.delta()[vertices[n]] = found ? measured.distances[n] : 0.0f;
    largest = std::max(largest, std::abs(static_cast<double>(mesh.delta()[vertices[n]])));
    lost += found ? 0 : 1;
  }
  if (lost > 0) {
    report.warnings.push_back(
        fmt::format("{} of {} new vertices have no implicit surface near them; their δ is taken as 0", lost,
                    vertices.size()));
  }
  return largest;
}

}  // namespace

double update_topology(TriangleMesh& mesh, const ImplicitSurface& surface, const Detection& detection,
                     const Parameters& parameters, UpkeepMemory& memory, FrameReport& report, StageTimer& timer) {
  const double h = parameters.dx_gamma * parameters.particle_spacing;
  const std::uint32_t first_new_id = mesh.next_id();
  {
    timer.begin("voxelization");
    const MeshLattice lattice(mesh.positions(), mesh.triangles(), h);
    timer.begin("topology_matching");
    const Disagreement disagreement = find_disagreement(lattice, mesh.delta(), surface, parameters);
    report.topology.disagreeing_nodes = disagreement.nodes.size();
    RemeshingRequest request;
    request.flagged_cells = united(detection.flagged_cells, disagreement.flagged_cells);
    MatchedVoxelization matched = match_topology(lattice, surface, request.flagged_cells, parameters);
    describe(matched, report.topology);
    report.flagged_cells = request.flagged_cells.size();
    request.nodes = std::move(matched.nodes);
    request.gamma = std::move(matched.gamma);
    LiquidAtNodes is_liquid(surface, h);
    request.is_liquid = [&](const openvdb::Coord& node) { return is_liquid(node); };
    timer.begin("remeshing");
    describe(remesh(mesh, lattice, request), report);
  }
  timer.begin("upkeep");
  std::vector<std::uint32_t> remeshed;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.ids()[v] >= first_new_id) remeshed.push_back(v);
  }
  forget_birth(mesh, remeshed);
  const UpkeepReport kept = keep_up(mesh, parameters, memory);
  report.upkeep = {kept.splits, kept.collapses + kept.fold_collapses + kept.sliver_collapses, kept.flips, kept.refused};

  std::vector<std::uint32_t> fresh;
  auto moved = kept.fresh.begin();
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const bool has_moved = moved != kept.fresh.end() && *moved == v;
    if (has_moved) ++moved;
    if (has_moved || mesh.ids()[v] >= first_new_id) fresh.push_back(v);
  }
  return measure_delta_of(mesh, fresh, surface, parameters, report, timer);
}

}  // namespace particle_surface_tracker
