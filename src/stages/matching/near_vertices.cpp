#include "near_vertices.h"

#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "stages/nodes/lattice_cell.h"

namespace particle_surface_tracker {

namespace {

/// Nodes along an edge of a block: 1 << kBlockBits.
constexpr int kBlockBits = 1;

/// Above 1 by more than rounding changes a position.
constexpr double kMargin = 1.0001;

NodeMasks blocks_around(const NodeMasks& set, int distance) {
  NodeMasks blocks;
  for (const NodeMasks::Leaf& leaf : set.leaves()) {
    for (int x = 0; x < 8; ++x) {
      for_each_bit(leaf.words[x],
                   [&](int bit) { blocks.insert(leaf.origin.offsetBy(x, bit >> 3, bit & 7) >> kBlockBits); });
    }
  }
  blocks.dilate(distance, distance);
  return blocks;
}

}  // namespace

NearVertices::NearVertices(const std::vector<Vec3f>& positions, const NodeMasks& set, double h, double reach)
    : is_near_(positions.size()) {
  const double blocks_per_meter = 1.0 / ((1 << kBlockBits) * h);
  const NodeMasks blocks = blocks_around(set, static_cast<int>(std::ceil(kMargin * reach * blocks_per_meter)));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), 4096), [&](const auto& range) {
    for (std::size_t v = range.begin(); v != range.end(); ++v) {
      is_near_[v] = static_cast<char>(blocks.contains(cell_of(positions[v].cast<double>() * blocks_per_meter)));
    }
  });
}

}  // namespace particle_surface_tracker
