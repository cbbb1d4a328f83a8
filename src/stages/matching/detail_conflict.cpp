#include "particle_surface_tracker/stages/detail_conflict.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "field_at_nodes.h"
#include "line_signs.h"
#include "matching_region.h"
#include "node_numbers.h"
#include "uncovered_particles.h"

namespace particle_surface_tracker {

namespace {

using openvdb::Coord;
using Nodes = std::vector<Coord>;

/// Nodes around an uncovered particle that get the side of φ [r].
constexpr double kAroundParticle = 1.25;

/// A neck of liquid between two bodies is hardly longer [r].
constexpr double kLongestWay = 5.0;

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

/// Finds the ways from liquid that the mesh does not hold to liquid that it does.
class Ways {
 public:
  Ways(const LineSigns& mesh, const FieldAtNodes& field) : mesh_(mesh), field_(field) {}

  /// The nodes at a surface, and those that it encloses.
  /// \return sorted.
  Nodes filled(const NodeMasks& at_surface) const {
    Nodes all = NodeNumbers(at_surface).nodes();
    openvdb::CoordBBox box;
    for (const Coord& node : all) box.expand(node);
    NodeMasks seen = at_surface;
    for (std::size_t next = 0; next < all.size(); ++next) {
      if (!is_inside(all[next])) continue;
      for (int axis = 0; axis < 3; ++axis) {
        for (const int step : {-1, 1}) {
          Coord neighbor = all[next];
          neighbor[axis] += step;
          if (!box.isInside(neighbor) || seen.contains(neighbor) || !is_inside(neighbor)) continue;
          seen.insert(neighbor);
          all.push_back(neighbor);
        }
      }
    }
    settle(all);
    return all;
  }

  /// Nodes of φ < 0 on the shortest ways from some nodes to the inside of the mesh, both ends included; none where it
  /// is not near.
  /// \param first sorted.
  Nodes from(const Nodes& first, int longest) const {
    NodeMasks seen = masks_of(first);
    std::vector<Nodes> layers = {NodeNumbers(field_.liquid(seen)).nodes()};
    Nodes goal;
    while (goal.empty() && static_cast<int>(layers.size()) <= longest && !layers.back().empty()) {
      NodeMasks next;
      for (const Coord& node : layers.back()) {
        for_each_neighbor(node, [&](const Coord& neighbor) {
          if (!seen.contains(neighbor)) next.insert(neighbor);
        });
      }
      unite(seen, next);
      layers.push_back(NodeNumbers(field_.liquid(next)).nodes());
      for (const Coord& node : layers.back()) {
        if (is_inside(node)) goal.push_back(node);
      }
    }
    Nodes way = goal;
    for (std::size_t layer = layers.size() - 1; layer > 0 && !goal.empty(); --layer) {
      NodeMasks ends = masks_of(goal);
      ends.dilate(1, 1);
      goal.clear();
      std::copy_if(layers[layer - 1].begin(), layers[layer - 1].end(), std::back_inserter(goal),
                   [&](const Coord& node) { return ends.contains(node); });
      way.insert(way.end(), goal.begin(), goal.end());
    }
    return way;
  }

 private:
  bool is_inside(const Coord& node) const {
    const LeafWords words = mesh_.leaf(node & ~7).inside;
    return (words[node.x() & 7] >> (8 * (node.y() & 7) + (node.z() & 7)) & 1) != 0;
  }

  const LineSigns& mesh_;
  const FieldAtNodes& field_;
};

}  // namespace

std::vector<Vec3f> find_uncovered_particles(const std::vector<Vec3f>& particles, const MeshQuery& mesh_query,
                                            const MatchedVoxelization& matched, const TriangleMesh& mesh,
                                            const IsosurfaceQuery& isosurface, double reach,
                                            const Parameters& parameters) {
  if (parameters.detection == DetectionMethod::kTau) return {};
  const double h = mesh_query.lattice().h();
  const LineSigns& before = mesh_query.signs();
  std::vector<Vec3f> uncovered;
  for (const std::uint32_t p : find_uncovered_particles(particles, before, matched, mesh, h, reach)) {
    const NodeMasks around = masks_of(nodes_around(particles[p], h, kAroundParticle * parameters.particle_spacing));
    NodeMasks missing = isosurface.field().liquid(around);
    remove_nodes(missing, inside_by_gamma(around, before, matched));
    if (!is_empty(missing)) uncovered.push_back(particles[p]);
  }
  return uncovered;
}

std::vector<Coord> find_conflicting_nodes(const MeshQuery& mesh_query, const ComponentDisagreement& pieces,
                                          const std::vector<Vec3f>& uncovered, const IsosurfaceQuery& isosurface,
                                          const Parameters& parameters) {
  if (pieces.scrap_cells.empty() && pieces.stray_cells.empty() && uncovered.empty()) return {};
  const double r = parameters.particle_spacing;
  const double h = mesh_query.lattice().h();
  const int longest = static_cast<int>(std::ceil(kLongestWay * r / h));
  const Ways ways(mesh_query.signs(), isosurface.field());
  Nodes found;
  const auto append = [&](const Nodes& nodes) { found.insert(found.end(), nodes.begin(), nodes.end()); };
  for (const Vec3f& particle : uncovered) {
    const Nodes around = nodes_around(particle, h, kAroundParticle * r);
    append(around);
    append(ways.from(around, longest));
  }
  for (const Nodes& scrap : connected_sets(pieces.scrap_cells)) {
    const Nodes all = ways.filled(nodes_at_cells(scrap));
    append(all);
    append(ways.from(all, longest));
  }
  for (const Nodes& piece : connected_sets(pieces.stray_cells)) {
    append(ways.from(ways.filled(nodes_at_cells(piece)), longest));
  }
  NodeMasks nodes = masks_of(found);
  nodes.dilate(1, 1);
  return NodeNumbers(nodes).nodes();
}

}  // namespace particle_surface_tracker
