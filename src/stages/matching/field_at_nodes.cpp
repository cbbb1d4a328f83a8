#include "field_at_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "lattice_weights.h"
#include "node_numbers.h"
#include "stages/distance_field/band_distances.h"

namespace particle_surface_tracker {

namespace {

/// Rounding can leave the squared distance of a node next to the isosurface below 0. No distance becomes 0, which would
/// have lost its sign [cells²].
constexpr float kSmallestSquared = 1e-8f;

using LeafValues = std::array<float, 512>;

std::size_t place_of(const openvdb::Coord& node) {
  return static_cast<std::size_t>(64 * (node.x() & 7) + 8 * (node.y() & 7) + (node.z() & 7));
}

constexpr int kLeafWidth = 8;

/// Of the leaves that some nodes are in, the cells within `reach` of those that the isosurface passes through; of other
/// leaves any [cells].
NodeMasks cells_within(const SurfaceCells& surface, double reach, const NodeMasks& nodes) {
  const int width = static_cast<int>(std::ceil(reach));
  const int leaf_width = (width + kLeafWidth) / kLeafWidth;
  NodeMasks leaves;  // by their coordinates
  for (const NodeMasks::Leaf& leaf : nodes.leaves()) leaves.insert(leaf.origin >> 3);
  leaves.dilate(leaf_width, leaf_width);
  NodeMasks cells;
  const std::vector<CutCell>& cut = surface.surface().triangulation.cells;
  for (const SurfaceCells::Leaf& leaf : surface.leaves()) {
    if (!leaves.contains(leaf.origin >> 3)) continue;
    for (std::uint32_t c = leaf.begin; c != leaf.end; ++c) cells.insert(cut[c].origin);
  }
  cells.dilate(width, width + 1);
  return cells;
}

/// The nodes of φ that the nodes of Γ need.
NodeMasks nodes_needed(const std::vector<openvdb::Coord>& nodes, double ratio) {
  NodeMasks needed;
  for (const openvdb::Coord& node : nodes) {
    LatticePlace(node, ratio).for_each_corner([&](const openvdb::Coord& corner, double) { needed.insert(corner); });
  }
  return needed;
}

}  // namespace

FieldAtNodes::FieldAtNodes(const ImplicitSurface& surface, double h, std::shared_ptr<const SurfaceCells> cells)
    : surface_(surface), h_(h), signs_(make_field_signs(surface)), cells_(std::move(cells)) {}

NodeMasks FieldAtNodes::liquid(const NodeMasks& set) const {
  NodeMasks found(set.leaves().size());
  if (h_ == surface_.dx) {
    for (const NodeMasks::Leaf& leaf : set.leaves()) {
      if (is_zero(leaf.words)) continue;
      const LeafWords inside = signs_.leaf(leaf.origin).inside;
      LeafWords& words = found.words_at(leaf.origin);
      for (int x = 0; x < 8; ++x) words[x] = leaf.words[x] & inside[x];
    }
    return found;
  }
  const std::vector<openvdb::Coord> nodes = NodeNumbers(set).nodes();
  const std::vector<float> phi = distances(nodes, h_);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (phi[n] < 0.0F) found.insert(nodes[n]);
  }
  return found;
}

std::vector<float> FieldAtNodes::distances(const std::vector<openvdb::Coord>& nodes, double reach) const {
  if (!cells_) cells_ = std::make_shared<SurfaceCells>(surface_);
  const double ratio = h_ / surface_.dx;
  const double reach_cells = reach / surface_.dx;
  const NodeMasks needed = nodes_needed(nodes, ratio);
  // A search that finds nothing takes longest, so nodes that are too far away are left out.
  const NodeMasks within = cells_within(*cells_, reach_cells, needed);
  NodeMasks near(needed.leaves().size());
  std::vector<std::uint32_t> near_leaf(needed.leaves().size(), LeafIndex::none);
  for (std::size_t n = 0; n < needed.leaves().size(); ++n) {
    const NodeMasks::Leaf& leaf = needed.leaves()[n];
    const std::uint32_t number = within.find(leaf.origin);
    if (number == LeafIndex::none) continue;
    LeafWords both = leaf.words;
    for (int x = 0; x < 8; ++x) both[x] &= within.leaves()[number].words[x];
    if (is_zero(both)) continue;
    near_leaf[n] = static_cast<std::uint32_t>(near.leaves().size());
    near.words_at(leaf.origin) = both;
  }
  const SquaredDistances squared = measure_distances(*cells_, near, reach_cells);

  std::vector<LeafValues> values(needed.leaves().size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, values.size(), 16), [&](const auto& range) {
    for (std::size_t n = range.begin(); n != range.end(); ++n) {
      const LineSigns::Leaf signs = signs_.leaf(needed.leaves()[n].origin);
      for (int x = 0; x < 8; ++x) {
        for_each_bit(needed.leaves()[n].words[x], [&](int bit) {
          const std::size_t place = 64 * x + bit;
          double distance = reach;
          if (near_leaf[n] != LeafIndex::none) {
            const float known = std::max(squared.leaf(near_leaf[n])[place], kSmallestSquared);
            distance = std::min(reach, std::sqrt(static_cast<double>(known)) * surface_.dx);
          }
          const bool is_inside = (signs.inside[x] >> bit & 1) != 0;
          values[n][place] = static_cast<float>(is_inside ? -distance : distance);
        });
      }
    }
  });

  std::vector<float> result(nodes.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, nodes.size(), 512), [&](const auto& range) {
    for (std::size_t n = range.begin(); n != range.end(); ++n) {
      double sum = 0.0;
      LatticePlace(nodes[n], ratio).for_each_corner([&](const openvdb::Coord& corner, double weight) {
        sum += weight * values[needed.find(corner & ~7)][place_of(corner)];
      });
      result[n] = static_cast<float>(sum);
    }
  });
  return result;
}

}  // namespace particle_surface_tracker
