#include "nodes_at_surfaces.h"

#include <cmath>

#include "lattice_weights.h"
#include "matching_region.h"

namespace particle_surface_tracker {

namespace {

/// Both lattices are one: the nodes are those that have a value.
NodesAtIsosurface nodes_of_field(const ImplicitSurface& surface) {
  const openvdb::FloatTree& tree = surface.field->tree();
  NodesAtIsosurface nodes{NodeMasks(tree.leafCount()), NodeMasks(tree.leafCount())};
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
    LeafWords& inside = nodes.inside.words_at(leaf->origin());
    LeafWords& outside = nodes.outside.words_at(leaf->origin());
    const float* values = leaf->buffer().data();
    for (int x = 0; x < 8; ++x) {
      for_each_bit(leaf->getValueMask().getWord<openvdb::Index64>(x),
                   [&](int bit) { (values[64 * x + bit] < 0.0f ? inside : outside)[x] |= std::uint64_t{1} << bit; });
    }
  }
  return nodes;
}

}  // namespace

NodesAtIsosurface nodes_at_isosurface(const ImplicitSurface& surface, double h) {
  const double ratio = h / surface.dx;
  if (ratio == 1.0) return nodes_of_field(surface);
  NodesAtIsosurface nodes;
  const auto field = surface.field->getConstAccessor();
  const std::vector<CutCell>& cut = surface.triangulation.cells;
  for (std::size_t c = 0; c + 1 < cut.size(); ++c) {
    openvdb::Coord lower;
    openvdb::Coord upper;
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = static_cast<int>(std::ceil(cut[c].origin[axis] / ratio));
      upper[axis] = static_cast<int>(std::floor((cut[c].origin[axis] + 1) / ratio));
    }
    const openvdb::CoordBBox box(lower, upper);
    for (auto node = box.begin(); node; ++node) {
      double value = 0.0;
      LatticePlace(*node, ratio, cut[c].origin).for_each_corner([&](const openvdb::Coord& corner, double weight) {
        value += weight * static_cast<double>(field.getValue(corner));
      });
      (value < 0.0 ? nodes.inside : nodes.outside).insert(*node);
    }
  }
  return nodes;
}

NodeMasks nodes_at_mesh(const MeshLattice& lattice) {
  NodeMasks nodes;
  for (const EdgeCrossing& crossing : lattice.crossings()) {
    openvdb::Coord next = crossing.edge.node;
    ++next[crossing.edge.axis];
    nodes.insert(crossing.edge.node);
    nodes.insert(next);
  }
  return nodes;
}

NodeMasks nodes_at_surfaces(const MeshLattice& lattice, const ImplicitSurface& surface) {
  NodeMasks nodes = nodes_at_mesh(lattice);
  const NodesAtIsosurface isosurface = nodes_at_isosurface(surface, lattice.h());
  unite(nodes, isosurface.inside);
  unite(nodes, isosurface.outside);
  return nodes;
}

}  // namespace particle_surface_tracker
