#include "topology_update.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <vector>

#include "fresh_delta.h"
#include "particle_surface_tracker/stages/component_disagreement.h"
#include "particle_surface_tracker/stages/detail_conflict.h"
#include "particle_surface_tracker/stages/disagreement.h"
#include "particle_surface_tracker/stages/empty_components.h"
#include "particle_surface_tracker/stages/mesh_lattice.h"
#include "particle_surface_tracker/stages/particle_cover.h"
#include "particle_surface_tracker/stages/remeshing.h"
#include "particle_surface_tracker/stages/topology_matching.h"
#include "particle_surface_tracker/stages/untangling.h"
#include "stages/matching/field_at_nodes.h"
#include "vertex_ids.h"

namespace particle_surface_tracker {

namespace {

using Cells = std::vector<openvdb::Coord>;

/// How often a frame's mesh is matched and re-meshed: again only where that has left scraps.
constexpr int kMostPasses = 3;

/// A particle that is not in the mesh is to be within r of it; until it is looked at again the mesh moves on [r].
constexpr double kCover = 0.9;

Cells united(const Cells& a, const Cells& b) {
  Cells all;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  return all;
}

void describe(const MatchedVoxelization& matched, FrameReport::Topology& topology) {
  topology.unknowns += matched.statistics.unknowns;
  topology.iterations += static_cast<std::size_t>(matched.statistics.iterations);
  topology.enlargements += static_cast<std::size_t>(matched.statistics.enlargements);
  topology.changed_nodes += matched.changed.size();
}

void describe(const RemeshingReport& remeshed, FrameReport& report) {
  FrameReport::Topology& topology = report.topology;
  topology.complex_cells += remeshed.complex_cells;
  topology.tangled_cells += remeshed.tangled_cells;
  topology.deep_cells += remeshed.deep_cells;
  topology.marked_by_growth += remeshed.marked_by_growth;
  topology.remeshed_cells += remeshed.remeshed_cells;
  topology.removed_components += remeshed.removed_components;
  topology.new_vertices += remeshed.new_vertices;
  topology.retries += remeshed.retries;
  topology.fallbacks += remeshed.fallbacks;
  if (remeshed.gave_up) {
    report.warnings.push_back("the mesh could not be re-meshed soundly; its topology stays as it was");
  }
}

/// Ids of the vertices that were made or moved after matching.
struct FreshIds {
  std::uint32_t first_remeshed;         ///< New vertices have ids from here on.
  std::uint32_t first_upkeep;           ///< From here on upkeep made them.
  std::vector<std::uint32_t> relaxed;   ///< Increasing; some may have gone.
  std::vector<std::uint32_t> kept_up;   ///< Increasing.
  std::vector<std::uint32_t> remeshed;  ///< Increasing: those that were moved where re-meshing had made them.
};

/// Marks the vertices of components that have a vertex of the first mesh.
std::vector<char> mark_detailed(const TriangleMesh& mesh, std::uint32_t original_vertices) {
  const std::shared_ptr<const VertexComponents> components = mesh.components();
  const std::vector<std::uint32_t>& component = components->of_vertex;
  std::vector<char> is_detailed(components->count, 0);
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.ids()[v] < original_vertices) is_detailed[component[v]] = 1;
  }
  std::vector<char> marks(mesh.vertex_count());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) marks[v] = is_detailed[component[v]];
  return marks;
}

/// All vertices that are new or have moved, in order.
std::vector<FreshVertex> fresh_vertices(const TriangleMesh& mesh, const FreshIds& ids,
                                        std::uint32_t original_vertices) {
  const auto is_in = [](const std::vector<std::uint32_t>& set, std::uint32_t id) {
    return std::binary_search(set.begin(), set.end(), id);
  };
  std::vector<FreshVertex> fresh;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const std::uint32_t id = mesh.ids()[v];
    const bool is_remeshed = (id >= ids.first_remeshed && id < ids.first_upkeep) || is_in(ids.remeshed, id);
    if (is_remeshed || id >= ids.first_upkeep || is_in(ids.relaxed, id) || is_in(ids.kept_up, id)) {
      fresh.push_back({v, is_remeshed, true});
    }
  }
  if (fresh.empty()) return fresh;
  const std::vector<char> is_detailed = mark_detailed(mesh, original_vertices);
  for (FreshVertex& vertex : fresh) vertex.has_detail = is_detailed[vertex.index] != 0;
  return fresh;
}

/// The particles that φ = 0 is within r of, by a wide measure: where the liquid is thin, the search that projects need
/// not find the place that is closest.
std::vector<Vec3f> near_isosurface(const std::vector<Vec3f>& particles, NarrowBand& band, double r) {
  constexpr double kNear = 1.15;
  const Projection found = band.project(particles, std::vector<float>(particles.size(), 0.0F), r, 2.0 * r);
  std::vector<Vec3f> near;
  for (std::size_t n = 0; n < particles.size(); ++n) {
    if (found.status[n] == ProjectionStatus::kFound && found.distances[n] <= kNear * r) near.push_back(particles[n]);
  }
  return near;
}

}  // namespace

double update_topology(TriangleMesh& mesh, const std::vector<Vec3f>& particles, const ImplicitSurface& surface,
                       const Detection& detection, std::uint32_t original_vertices, const Parameters& parameters,
                       NarrowBand& band, UpkeepMemory& memory, FrameReport& report, StageTimer& timer,
                       TopologyCells* record) {
  const double r = parameters.particle_spacing;
  const double h = parameters.dx_gamma * r;
  const std::uint32_t first_new_id = mesh.next_id();
  const IsosurfaceQuery isosurface(surface, h, band.cells());
  timer.begin("topology_matching");
  ComponentDisagreement pieces = find_component_disagreement(mesh, original_vertices, isosurface, parameters);
  std::vector<Vec3f> missed, uncovered;
  std::optional<MeshLattice> lattice;
  std::optional<MeshQuery> before;
  MatchedVoxelization matched;
  bool mesh_was_remeshed = false;
  for (int pass = 0; pass < kMostPasses; ++pass) {
    timer.begin("voxelization");
    lattice.emplace(mesh.positions(), mesh.triangles(), h);
    timer.begin("topology_matching");
    before.emplace(*lattice);
    Cells flagged = united(pieces.bridge_cells, pieces.scrap_cells);
    if (pass == 0) {
      const Disagreement disagreement = find_disagreement(*before, mesh.delta(), isosurface, parameters);
      report.topology.disagreeing_nodes = disagreement.nodes.size();
      flagged = united(united(flagged, detection.flagged_cells), disagreement.flagged_cells);
      missed = find_uncovered_particles(particles, *before, {}, mesh, kCover * r, parameters);
      uncovered = near_missing_liquid(missed, *before, {}, isosurface, parameters);
    }
    // Where matching alone has not helped, detail gives way.
    if (pass > 0) pieces.scrap_cells = flagged;
    const Cells at_conflicts = find_conflicting_nodes(*before, pieces, uncovered, isosurface, parameters);
    report.topology.uncovered_particles += uncovered.size();
    report.topology.conflicting_nodes += at_conflicts.size();
    ++report.topology.passes;
    RemeshingRequest request;
    TopologyCells cells;
    TopologyCells* const to_record = record != nullptr ? &cells : nullptr;
    matched = match_topology(*before, isosurface, flagged, parameters, at_conflicts, to_record);
    describe(matched, report.topology);
    report.flagged_cells += flagged.size();
    request.flagged_cells = united(flagged, find_hidden_films(*lattice, at_conflicts, matched));
    request.nodes = matched.nodes;
    request.gamma = matched.gamma;
    request.is_liquid = [&](const openvdb::Coord& node) {
      return isosurface.field().distances({node}, h).front() < 0.0F;
    };
    request.remesh_crossings = pass == 0 && parameters.self_intersections == SelfIntersections::kRemesh;
    timer.begin("remeshing");
    const RemeshingReport remeshed = remesh(mesh, *lattice, request, memory.twins, to_record);
    describe(remeshed, report);
    if (record != nullptr) record->add(cells);
    if (!remeshed.changed()) break;
    mesh_was_remeshed = true;
    // What was cut may have left scraps that the liquid does not have.
    timer.begin("topology_matching");
    pieces = find_component_disagreement(mesh, original_vertices, isosurface, parameters);
    uncovered.clear();
    if (pass == 0) {
      uncovered = find_uncovered_particles(particles, *before, matched, mesh, r, parameters);
      uncovered = near_missing_liquid(uncovered, *before, matched, isosurface, parameters);
    }
    if (pieces.none() && uncovered.empty()) break;
  }
  report.topology.removed_components += remove_empty_components(mesh, original_vertices, first_new_id, particles, r);
  timer.begin("untangling");
  FreshIds fresh;
  fresh.first_remeshed = first_new_id;
  fresh.first_upkeep = mesh.next_id();
  std::vector<std::uint32_t> remeshed;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.ids()[v] >= first_new_id) remeshed.push_back(v);
  }
  mark_as_remeshed(mesh, remeshed);
  const UntanglingReport relaxed = untangle(mesh, memory);
  fresh.relaxed = ids_of(mesh, relaxed.moved);
  timer.begin("upkeep");
  const UpkeepReport kept = keep_up(mesh, parameters, memory);
  report.upkeep.splits = kept.splits;
  report.upkeep.collapses = kept.collapses + kept.fold_collapses + kept.sliver_collapses;
  report.upkeep.flips = kept.flips;
  report.upkeep.tangles = relaxed.tangles;
  report.upkeep.untangled = relaxed.untangled;
  report.upkeep.refused = kept.refused;
  fresh.kept_up = ids_of(mesh, kept.fresh);
  // Upkeep alone moves the surface too little to lose a particle that was well inside.
  if (mesh_was_remeshed) missed = find_uncovered_particles(particles, *before, matched, mesh, r, parameters);
  if (!missed.empty()) {
    const std::vector<Vec3f> near = near_isosurface(missed, band, r);
    timer.begin("upkeep");
    fresh.remeshed = ids_of(mesh, cover_particles(mesh, original_vertices, near, r));
  }

  return measure_fresh_delta(mesh, fresh_vertices(mesh, fresh, original_vertices), band, parameters, report);
}

}  // namespace particle_surface_tracker
