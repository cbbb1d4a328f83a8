#include "particle_surface_tracker/stages/detail_conflict.h"

#include <algorithm>
#include <cmath>

#include "field_at_nodes.h"
#include "line_signs.h"
#include "liquid_ways.h"
#include "matching_region.h"
#include "node_numbers.h"
#include "stages/remeshing/lattice_parts.h"
#include "uncovered_particles.h"

namespace particle_surface_tracker {

namespace {

using openvdb::Coord;
using Nodes = std::vector<Coord>;

/// Nodes around an uncovered particle that get the side of φ [r]. φ = 0 is within r of it, and the liquid behind that
/// reaches to the next node, but may be thinner than a cell.
double around_particle(double h, double r) {
  return r + h;
}

/// A neck of liquid between two bodies is hardly longer [r].
constexpr double kLongestWay = 5.0;

/// A way along lattice edges is longer than a straight one by at most this.
const double kDetour = std::sqrt(3.0);

template <typename Visit>
void for_each_neighbor(const Coord& node, Visit&& visit) {
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) visit(node.offsetBy(x, y, z));
      }
    }
  }
}

Nodes nodes_around(const Vec3f& particle, double h, double radius) {
  const Vec3d place = particle.cast<double>() / h;
  const double reach = radius / h;
  Nodes nodes;
  Coord lower, upper;
  for (int axis = 0; axis < 3; ++axis) {
    lower[axis] = static_cast<int>(std::ceil(place[axis] - reach));
    upper[axis] = static_cast<int>(std::floor(place[axis] + reach));
  }
  for (auto node = openvdb::CoordBBox(lower, upper).begin(); node; ++node) {
    const Vec3d offset = Vec3d((*node).x(), (*node).y(), (*node).z()) - place;
    if (offset.squaredNorm() <= reach * reach) nodes.push_back(*node);
  }
  return nodes;
}

/// The sets that cells form which touch each other.
/// \param cells sorted.
std::vector<Nodes> connected_sets(const Nodes& cells) {
  std::vector<Nodes> sets;
  std::vector<char> is_taken(cells.size(), 0);
  for (std::size_t first = 0; first < cells.size(); ++first) {
    if (is_taken[first] != 0) continue;
    is_taken[first] = 1;
    Nodes set = {cells[first]};
    for (std::size_t next = 0; next < set.size(); ++next) {
      const Coord cell = set[next];
      for_each_neighbor(cell, [&](const Coord& neighbor) {
        const auto found = std::lower_bound(cells.begin(), cells.end(), neighbor);
        if (found == cells.end() || *found != neighbor) return;
        char& taken = is_taken[static_cast<std::size_t>(found - cells.begin())];
        if (taken == 0) set.push_back(neighbor);
        taken = 1;
      });
    }
    sets.push_back(std::move(set));
  }
  return sets;
}

}  // namespace

std::vector<Vec3f> find_uncovered_particles(const std::vector<Vec3f>& particles, const MeshQuery& mesh_query,
                                            const MatchedVoxelization& matched, const TriangleMesh& mesh, double reach,
                                            const Parameters& parameters) {
  if (parameters.detection == DetectionMethod::kTau) return {};
  std::vector<Vec3f> uncovered;
  for (const std::uint32_t p :
       find_uncovered_particles(particles, mesh_query.signs(), matched, mesh, mesh_query.lattice().h(), reach)) {
    uncovered.push_back(particles[p]);
  }
  return uncovered;
}

std::vector<Vec3f> near_missing_liquid(const std::vector<Vec3f>& uncovered, const MeshQuery& mesh_query,
                                       const MatchedVoxelization& matched, const IsosurfaceQuery& isosurface,
                                       const Parameters& parameters) {
  const double h = mesh_query.lattice().h();
  std::vector<Nodes> surroundings;
  for (const Vec3f& particle : uncovered) {
    surroundings.push_back(nodes_around(particle, h, around_particle(h, parameters.particle_spacing)));
  }
  const NodeMasks all = masks_of(surroundings);
  NodeMasks missing = isosurface.field().liquid(all);
  remove_nodes(missing, inside_by_gamma(all, mesh_query.signs(), matched));
  std::vector<Vec3f> found;
  for (std::size_t n = 0; n < uncovered.size(); ++n) {
    const Nodes& around = surroundings[n];
    if (std::any_of(around.begin(), around.end(), [&](const Coord& node) { return missing.contains(node); })) {
      found.push_back(uncovered[n]);
    }
  }
  return found;
}

std::vector<Coord> find_conflicting_nodes(const MeshQuery& mesh_query, const ComponentDisagreement& pieces,
                                          const std::vector<Vec3f>& uncovered, const IsosurfaceQuery& isosurface,
                                          const Parameters& parameters) {
  if (pieces.scrap_cells.empty() && pieces.stray_cells.empty() && uncovered.empty()) return {};
  const double r = parameters.particle_spacing;
  const double h = mesh_query.lattice().h();
  const int longest = static_cast<int>(std::ceil(kDetour * kLongestWay * r / h));
  const LiquidWays ways(mesh_query, isosurface.field());
  Nodes found;
  const auto append = [&](const Nodes& nodes) { found.insert(found.end(), nodes.begin(), nodes.end()); };
  std::vector<Nodes> surroundings;
  for (const Vec3f& particle : uncovered) surroundings.push_back(nodes_around(particle, h, around_particle(h, r)));
  const NodeMasks inside = inside_by_gamma(masks_of(surroundings), mesh_query.signs(), {});
  std::vector<Nodes> outside;
  for (Nodes& around : surroundings) {
    append(around);
    if (std::any_of(around.begin(), around.end(), [&](const Coord& node) { return inside.contains(node); })) {
      append(ways.from(around, longest));
    } else {
      outside.push_back(std::move(around));
    }
  }
  append(ways.from_each(outside, longest));
  for (const Nodes& scrap : connected_sets(pieces.scrap_cells)) {
    const PieceNodes nodes = ways.nodes_of(scrap);
    append(nodes.all);
    append(ways.from(nodes.start, longest));
  }
  for (const Nodes& piece : connected_sets(pieces.stray_cells)) {
    append(ways.from(ways.nodes_of(piece).start, longest));
  }
  NodeMasks nodes = masks_of(found);
  nodes.dilate(1, 1);
  return NodeNumbers(nodes).nodes();
}

std::vector<Coord> find_hidden_films(const MeshLattice& lattice, const std::vector<Coord>& at_conflicts,
                                     const MatchedVoxelization& matched) {
  NodeMasks liquid;
  for (std::size_t n = 0; n < matched.nodes.size(); ++n) {
    if (matched.gamma[n] < 0.0F && std::binary_search(at_conflicts.begin(), at_conflicts.end(), matched.nodes[n]))
      liquid.insert(matched.nodes[n]);
  }
  Nodes cells;
  const NodeNumbers numbers(liquid);
  for (const Coord& node : numbers.nodes()) {
    for (std::uint8_t axis = 0; axis < 3; ++axis) {
      const LatticeEdge edge{node, axis};
      if (!liquid.contains(remeshing::moved(node, axis, 1)) || lattice.crossings_on(edge).empty()) continue;
      for (const Coord& cell : remeshing::cells_around(edge)) cells.push_back(cell);
    }
  }
  settle(cells);
  return cells;
}

}  // namespace particle_surface_tracker
