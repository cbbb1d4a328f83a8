#include "particle_surface_tracker/stages/disagreement.h"

#include <algorithm>
#include <cmath>

#include "detail_cover.h"
#include "field_at_nodes.h"
#include "line_signs.h"
#include "matching_region.h"
#include "node_numbers.h"
#include "nodes_at_surfaces.h"
#include "triangle_extent.h"

namespace particle_surface_tracker {

namespace {

/// A mesh that is farther than this from a node of the isosurface, and than its δ, does not represent it [cells].
const double kCellDiagonal = std::sqrt(3.0);

/// An isosurface that is farther than this from a node of the mesh, and than its δ, does not hold it [cells].
constexpr double kCell = 1.0;

/// Triangles with a longer edge are large [cells]. The isosurface is at the distance δ of every vertex that is not
/// flagged, so smaller triangles have nowhere to hide much.
constexpr double kLargeEdge = 2.0;

/// The nodes that are on the other side for the mesh than for φ.
NodeMasks misplaced_nodes(const NodesAtIsosurface& nodes, const LineSigns& mesh) {
  NodeMasks misplaced;
  const auto add = [&](const NodeMasks& side, bool is_inside) {
    for (const NodeMasks::Leaf& leaf : side.leaves()) {
      if (is_zero(leaf.words)) continue;
      LeafWords words = mesh.leaf(leaf.origin).inside;
      for (int x = 0; x < 8; ++x) words[x] = leaf.words[x] & (is_inside ? ~words[x] : words[x]);
      if (is_zero(words)) continue;
      add_words(words, misplaced.words_at(leaf.origin));
    }
  };
  add(nodes.inside, true);
  add(nodes.outside, false);
  return misplaced;
}

/// Takes the nodes out that are on the same side for the mesh and for φ, whose lattices are one.
void remove_agreeing(NodeMasks& set, const LineSigns& mesh, const LineSigns& field) {
  for (const NodeMasks::Leaf& leaf : set.leaves()) {
    const LeafWords in_mesh = mesh.leaf(leaf.origin).inside;
    const LeafWords in_field = field.leaf(leaf.origin).inside;
    LeafWords& words = set.words_at(leaf.origin);
    for (int x = 0; x < 8; ++x) words[x] &= in_mesh[x] ^ in_field[x];
  }
}

/// Nodes at the isosurface that are on the wrong side of the mesh, and too far from it.
std::vector<openvdb::Coord> disagreement_at_isosurface(const MeshLattice& lattice, const std::vector<float>& delta,
                                                       const ImplicitSurface& surface, const LineSigns& mesh) {
  NodeMasks suspects = misplaced_nodes(nodes_at_isosurface(surface, lattice.h()), mesh);
  // Where the mesh passes within a cell's diagonal no triangle need be asked.
  remove_nodes(suspects, nodes_next_to_other_side(suspects, mesh));
  if (is_empty(suspects)) return {};
  return nodes_beyond_detail(suspects, lattice, delta, kCellDiagonal * lattice.h());
}

/// Nodes next to large triangles that have no vertex in the cells around them and may be on the wrong side, and the
/// largest |δ| of the triangles there.
struct NodesAwayFromVertices {
  std::vector<openvdb::Coord> nodes;
  std::vector<double> detail;  ///< [m]
};

NodesAwayFromVertices nodes_away_from_vertices(const MeshLattice& lattice, const std::vector<float>& delta,
                                               const IsosurfaceQuery& isosurface, const LineSigns& mesh) {
  const double longest = kLargeEdge * lattice.h();
  const auto squared_longest = static_cast<float>(longest * longest);
  std::vector<char> is_large(lattice.triangles().size(), 0);
  bool any = false;
  for (std::size_t t = 0; t < is_large.size(); ++t) {
    const Triangle& triangle = lattice.triangles()[t];
    if (!may_be_longer(lattice.positions(), triangle, squared_longest)) continue;
    if (longest_edge(lattice.positions(), triangle) <= longest) continue;
    is_large[t] = 1;
    any = true;
  }
  if (!any) return {};
  NodeMasks near_vertices;
  for (std::uint32_t v = 0; v < lattice.positions().size(); ++v) near_vertices.insert(lattice.cell_of_vertex(v));
  near_vertices.dilate(0, 1);
  NodeMasks set;
  const auto for_each_end = [&](auto&& visit) {
    for (const EdgeCrossing& crossing : lattice.crossings()) {
      if (is_large[crossing.triangle] == 0) continue;
      openvdb::Coord next = crossing.edge.node;
      ++next[crossing.edge.axis];
      visit(crossing.edge.node, crossing.triangle);
      visit(next, crossing.triangle);
    }
  };
  for_each_end([&](const openvdb::Coord& node, std::uint32_t) { set.insert(node); });
  remove_nodes(set, near_vertices);
  if (lattice.h() == isosurface.surface().dx) remove_agreeing(set, mesh, isosurface.field().signs());
  const NodeNumbers numbers(set);
  NodesAwayFromVertices result{numbers.nodes(), std::vector<double>(numbers.nodes().size(), 0.0)};
  for_each_end([&](const openvdb::Coord& node, std::uint32_t triangle) {
    const std::uint32_t n = numbers.find(node);
    if (n == NodeNumbers::none) return;
    result.detail[n] = std::max(result.detail[n], largest_delta(lattice.triangles()[triangle], delta));
  });
  return result;
}

/// Nodes at the mesh that are on the wrong side of the isosurface, and too far from it.
std::vector<openvdb::Coord> disagreement_at_mesh(const MeshLattice& lattice, const std::vector<float>& delta,
                                                 const IsosurfaceQuery& isosurface, const LineSigns& mesh) {
  const NodesAwayFromVertices suspects = nodes_away_from_vertices(lattice, delta, isosurface, mesh);
  if (suspects.nodes.empty()) return {};
  const double slack = kCell * lattice.h();
  const double reach = *std::max_element(suspects.detail.begin(), suspects.detail.end()) + 2.0 * slack;
  const std::vector<float> phi = isosurface.field().distances(suspects.nodes, reach);
  std::vector<openvdb::Coord> nodes;
  for (std::size_t n = 0; n < phi.size(); ++n) {
    if (std::abs(static_cast<double>(phi[n])) <= suspects.detail[n] + slack) continue;
    const bool is_inside = lattice.winding_number(suspects.nodes[n]) >= 1;
    if (is_inside != (phi[n] < 0.0f)) nodes.push_back(suspects.nodes[n]);
  }
  return nodes;
}

std::vector<openvdb::Coord> cells_around(const std::vector<openvdb::Coord>& nodes) {
  NodeMasks cells;
  for (const openvdb::Coord& node : nodes) cells.insert(node);
  cells.dilate(1, 0);
  return NodeNumbers(cells).nodes();
}

}  // namespace

Disagreement find_disagreement(const MeshQuery& mesh, const std::vector<float>& delta,
                               const IsosurfaceQuery& isosurface, const Parameters& parameters) {
  if (parameters.detection == DetectionMethod::kTau) return {};
  Disagreement result;
  const MeshLattice& lattice = mesh.lattice();
  result.nodes = disagreement_at_isosurface(lattice, delta, isosurface.surface(), mesh.signs());
  const std::vector<openvdb::Coord> at_mesh = disagreement_at_mesh(lattice, delta, isosurface, mesh.signs());
  result.nodes.insert(result.nodes.end(), at_mesh.begin(), at_mesh.end());
  std::sort(result.nodes.begin(), result.nodes.end());
  result.nodes.erase(std::unique(result.nodes.begin(), result.nodes.end()), result.nodes.end());
  result.flagged_cells = cells_around(result.nodes);
  return result;
}

}  // namespace particle_surface_tracker
