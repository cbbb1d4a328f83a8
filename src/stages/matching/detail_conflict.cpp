#include "particle_surface_tracker/stages/detail_conflict.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "field_at_nodes.h"
#include "line_signs.h"
#include "matching_region.h"
#include "node_numbers.h"
#include "stages/remeshing/lattice_parts.h"
#include "uncovered_particles.h"

namespace particle_surface_tracker {

namespace {

using openvdb::Coord;
using Nodes = std::vector<Coord>;

/// Nodes around an uncovered particle that get the side of φ [r].
constexpr double kAroundParticle = 1.25;

/// A neck of liquid between two bodies is hardly longer [r].
constexpr double kLongestWay = 5.0;

/// A way along lattice edges is longer than a straight one by at most this.
const double kDetour = std::sqrt(3.0);

void settle(Nodes& nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

NodeMasks masks_of(const Nodes& nodes) {
  NodeMasks masks;
  for (const Coord& node : nodes) masks.insert(node);
  return masks;
}

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

/// Calls visit(neighbor, edge) for the six nodes that a lattice edge joins to a node.
template <typename Visit>
void for_each_edge_at(const Coord& node, Visit&& visit) {
  for (std::uint8_t axis = 0; axis < 3; ++axis) {
    const Coord below = remeshing::moved(node, axis, -1);
    visit(below, LatticeEdge{below, axis});
    visit(remeshing::moved(node, axis, 1), LatticeEdge{node, axis});
  }
}

/// The nodes of a piece of mesh.
struct PieceNodes {
  Nodes all;    ///< At its surface, and those that it encloses; sorted.
  Nodes start;  ///< Of these: not inside another part of the mesh. From here a way leads to the rest of it.
};

/// Finds the ways from liquid that the mesh does not hold to liquid that it does.
class Ways {
 public:
  Ways(const MeshQuery& mesh, const FieldAtNodes& field)
      : lattice_(mesh.lattice()), mesh_(mesh.signs()), field_(field) {}

  PieceNodes nodes_of(const Nodes& cells) const {
    PieceNodes piece{NodeNumbers(nodes_at_cells(cells)).nodes(), {}};
    openvdb::CoordBBox box;
    for (const Coord& node : piece.all) box.expand(node);
    NodeMasks seen, of_others;
    const std::size_t at_surface = piece.all.size();
    for (std::size_t n = 0; n < at_surface; ++n) {
      const Coord first = piece.all[n];
      if (seen.contains(first) || !is_inside(first)) continue;
      const Body body = body_at(first, box, seen);
      if (body.goes_on) {
        for (const Coord& node : body.nodes) of_others.insert(node);
      } else {
        piece.all.insert(piece.all.end(), body.nodes.begin(), body.nodes.end());
      }
    }
    settle(piece.all);
    std::copy_if(piece.all.begin(), piece.all.end(), std::back_inserter(piece.start),
                 [&](const Coord& node) { return !of_others.contains(node); });
    return piece;
  }

  /// Nodes of φ < 0 on the shortest ways from some nodes to the inside of the mesh, both ends included; none where it
  /// is not near. A way goes along lattice edges: the triangulation keeps nodes apart that only share a face or a cell.
  /// \param first sorted.
  Nodes from(const Nodes& first, int longest) const {
    NodeMasks seen = masks_of(first);
    std::vector<Nodes> layers = {NodeNumbers(field_.liquid(seen)).nodes()};
    Nodes goal;
    while (goal.empty() && static_cast<int>(layers.size()) <= longest && !layers.back().empty()) {
      NodeMasks next = nodes_beside(masks_of(layers.back()));
      remove_nodes(next, seen);
      unite(seen, next);
      layers.push_back(NodeNumbers(field_.liquid(next)).nodes());
      for (const Coord& node : layers.back()) {
        if (is_inside(node)) goal.push_back(node);
      }
    }
    Nodes way = goal;
    for (std::size_t layer = layers.size() - 1; layer > 0 && !goal.empty(); --layer) {
      const NodeMasks ends = nodes_beside(masks_of(goal));
      goal.clear();
      std::copy_if(layers[layer - 1].begin(), layers[layer - 1].end(), std::back_inserter(goal),
                   [&](const Coord& node) { return ends.contains(node); });
      way.insert(way.end(), goal.begin(), goal.end());
    }
    return way;
  }

 private:
  /// Nodes that one part of the mesh encloses.
  struct Body {
    Nodes nodes;           ///< In a box.
    bool goes_on = false;  ///< Whether there are more beyond it.
  };

  /// \param seen receives the nodes.
  Body body_at(const Coord& first, const openvdb::CoordBBox& box, NodeMasks& seen) const {
    Body body{{first}};
    seen.insert(first);
    for (std::size_t next = 0; next < body.nodes.size(); ++next) {
      for_each_edge_at(Coord(body.nodes[next]), [&](const Coord& neighbor, const LatticeEdge& edge) {
        if (seen.contains(neighbor) || !is_inside(neighbor) || !lattice_.crossings_on(edge).empty()) return;
        if (box.isInside(neighbor)) {
          seen.insert(neighbor);
          body.nodes.push_back(neighbor);
        } else {
          body.goes_on = true;
        }
      });
    }
    return body;
  }

  bool is_inside(const Coord& node) const {
    const LeafWords words = mesh_.leaf(node & ~7).inside;
    return (words[node.x() & 7] >> (8 * (node.y() & 7) + (node.z() & 7)) & 1) != 0;
  }

  const MeshLattice& lattice_;
  const LineSigns& mesh_;
  const FieldAtNodes& field_;
};

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
  std::vector<Vec3f> found;
  for (const Vec3f& particle : uncovered) {
    const NodeMasks around = masks_of(nodes_around(particle, h, kAroundParticle * parameters.particle_spacing));
    NodeMasks missing = isosurface.field().liquid(around);
    remove_nodes(missing, inside_by_gamma(around, mesh_query.signs(), matched));
    if (!is_empty(missing)) found.push_back(particle);
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
  const Ways ways(mesh_query, isosurface.field());
  Nodes found;
  const auto append = [&](const Nodes& nodes) { found.insert(found.end(), nodes.begin(), nodes.end()); };
  for (const Vec3f& particle : uncovered) {
    const Nodes around = nodes_around(particle, h, kAroundParticle * r);
    append(around);
    append(ways.from(around, longest));
  }
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
