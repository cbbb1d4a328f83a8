#include "liquid_ways.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "matching_region.h"
#include "node_numbers.h"
#include "stages/remeshing/lattice_parts.h"
#include "uncovered_particles.h"

namespace particle_surface_tracker {

namespace {

using openvdb::Coord;
using Nodes = LiquidWays::Nodes;

/// Calls visit(neighbor, edge) for the six nodes that a lattice edge joins to a node.
template <typename Visit>
void for_each_edge_at(const Coord& node, Visit&& visit) {
  for (std::uint8_t axis = 0; axis < 3; ++axis) {
    const Coord below = remeshing::moved(node, axis, -1);
    visit(below, LatticeEdge{below, axis});
    visit(remeshing::moved(node, axis, 1), LatticeEdge{node, axis});
  }
}

/// How many lattice edges lead from each of some nodes to the nearest goal, through these nodes.
class StepsToGoals {
 public:
  static constexpr int kFar = std::numeric_limits<int>::max();

  /// \param liquid the nodes, the goals among them.
  StepsToGoals(const NodeMasks& liquid, const NodeMasks& goals, int longest)
      : numbers_(liquid), steps_(numbers_.nodes().size(), kFar) {
    Nodes last = NodeNumbers(goals).nodes();
    for (const Coord& node : last) steps_[numbers_.find(node)] = 0;
    for (int step = 1; step <= longest && !last.empty(); ++step) {
      Nodes next;
      for (const Coord& node : last) {
        for_each_edge_at(node, [&](const Coord& neighbor, const LatticeEdge&) {
          const std::uint32_t number = numbers_.find(neighbor);
          if (number == NodeNumbers::none || steps_[number] != kFar) return;
          steps_[number] = step;
          next.push_back(neighbor);
        });
      }
      last = std::move(next);
    }
  }

  int at(const Coord& node) const {
    const std::uint32_t number = numbers_.find(node);
    return number == NodeNumbers::none ? kFar : steps_[number];
  }

  /// The nodes on all shortest ways from a set to a goal; none where there is no way.
  Nodes shortest_ways(const Nodes& start) const {
    int left = kFar;
    for (const Coord& node : start) left = std::min(left, at(node));
    if (left == kFar) return {};
    Nodes front;
    std::copy_if(start.begin(), start.end(), std::back_inserter(front),
                 [&](const Coord& node) { return at(node) == left; });
    Nodes ways = front;
    for (; left > 0; --left) {
      Nodes next;
      for (const Coord& node : front) {
        for_each_edge_at(node, [&](const Coord& neighbor, const LatticeEdge&) {
          if (at(neighbor) == left - 1) next.push_back(neighbor);
        });
      }
      settle(next);
      front = std::move(next);
      ways.insert(ways.end(), front.begin(), front.end());
    }
    return ways;
  }

 private:
  NodeNumbers numbers_;
  std::vector<int> steps_;
};

}  // namespace

PieceNodes LiquidWays::nodes_of(const Nodes& cells) const {
  PieceNodes piece{NodeNumbers(nodes_at_cells(cells)).nodes(), {}};
  openvdb::CoordBBox box;
  for (const Coord& node : piece.all) box.expand(node);
  NodeMasks seen, of_others;
  Nodes enclosed;
  const std::size_t at_surface = piece.all.size();
  for (std::size_t n = 0; n < at_surface; ++n) {
    const Coord first = piece.all[n];
    if (seen.contains(first) || !is_inside(first)) continue;
    const Body body = body_at(first, box, seen);
    if (body.goes_on) {
      for (const Coord& node : body.nodes) of_others.insert(node);
    } else {
      enclosed.insert(enclosed.end(), body.nodes.begin(), body.nodes.end());
    }
  }
  piece.all.insert(piece.all.end(), enclosed.begin(), enclosed.end());
  settle(piece.all);
  // A way from a node beside the piece would join the rest of the mesh to what need not be joined to the piece. Where
  // φ has no liquid inside, or the piece is between the nodes, any node will do that is not inside another part.
  settle(enclosed);
  if (!is_empty(field_.liquid(masks_of(enclosed)))) {
    piece.start = std::move(enclosed);
    return piece;
  }
  std::copy_if(piece.all.begin(), piece.all.end(), std::back_inserter(piece.start),
               [&](const Coord& node) { return !of_others.contains(node); });
  return piece;
}

LiquidWays::Nodes LiquidWays::from(const Nodes& first, int longest) const {
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

LiquidWays::Nodes LiquidWays::from_each(const std::vector<Nodes>& starts, int longest) const {
  NodeMasks seen = masks_of(starts);
  NodeMasks liquid = field_.liquid(seen), layer = liquid, goals;
  for (int step = 0; step < longest && !is_empty(layer); ++step) {
    NodeMasks next = nodes_beside(layer);
    remove_nodes(next, seen);
    unite(seen, next);
    layer = field_.liquid(next);
    const NodeMasks reached = inside_by_gamma(layer, mesh_, {});
    unite(goals, reached);
    remove_nodes(layer, reached);
    unite(liquid, layer);
  }
  if (is_empty(goals)) return {};
  unite(liquid, goals);
  const StepsToGoals steps(liquid, goals, longest);
  Nodes ways;
  for (const Nodes& start : starts) {
    const Nodes its = steps.shortest_ways(start);
    ways.insert(ways.end(), its.begin(), its.end());
  }
  return ways;
}

LiquidWays::Body LiquidWays::body_at(const Coord& first, const openvdb::CoordBBox& box, NodeMasks& seen) const {
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

bool LiquidWays::is_inside(const Coord& node) const {
  const LeafWords words = mesh_.leaf(node & ~7).inside;
  return (words[node.x() & 7] >> (8 * (node.y() & 7) + (node.z() & 7)) & 1) != 0;
}

}  // namespace particle_surface_tracker
