#include "particle_surface_tracker/core/topology_cells.h"

#include <algorithm>
#include <iterator>

namespace particle_surface_tracker {

namespace {

void unite(std::vector<openvdb::Coord>& cells, const std::vector<openvdb::Coord>& more) {
  std::vector<openvdb::Coord> all;
  std::set_union(cells.begin(), cells.end(), more.begin(), more.end(), std::back_inserter(all));
  cells = std::move(all);
}

void unite(NodeValues& values, const NodeValues& more) {
  NodeValues all;
  std::size_t a = 0, b = 0;
  while (a < values.nodes.size() || b < more.nodes.size()) {
    const bool takes_new = a == values.nodes.size() || (b < more.nodes.size() && !(values.nodes[a] < more.nodes[b]));
    const NodeValues& from = takes_new ? more : values;
    const std::size_t n = takes_new ? b : a;
    all.nodes.push_back(from.nodes[n]);
    all.values.push_back(from.values[n]);
    if (takes_new && a < values.nodes.size() && values.nodes[a] == more.nodes[b]) ++a;
    ++(takes_new ? b : a);
  }
  values = std::move(all);
}

}  // namespace

void TopologyCells::add(const TopologyCells& other) {
  cell_size = other.cell_size;
  unite(flagged, other.flagged);
  unite(complex, other.complex);
  unite(tangled, other.tangled);
  unite(deep, other.deep);
  unite(marked, other.marked);
  unite(front, other.front);
  unite(changed_nodes, other.changed_nodes);
  unite(fixed, other.fixed);
  unite(unknown, other.unknown);
}

}  // namespace particle_surface_tracker
