#include "detail_cover.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "near_vertices.h"
#include "node_numbers.h"
#include "triangle_extent.h"

namespace particle_surface_tracker {

namespace {

/// Nodes along an edge of a leaf.
constexpr int kWidth = 8;

/// Triangles are looked at by where they are if their length and what they explain are not more than this [cells].
constexpr double kUsualReach = 8.0;

/// The lattice places between which a node may be for a triangle to explain it.
openvdb::CoordBBox nodes_around(const Corners& corners, double reach, double h) {
  openvdb::CoordBBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [lower, upper] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
    box.min()[axis] = static_cast<int>(std::ceil((lower - reach) / h));
    box.max()[axis] = static_cast<int>(std::floor((upper + reach) / h));
  }
  return box;
}

/// Calls visit(node) for the nodes of a set in a box.
template <typename Visit>
void for_each_node_in(const NodeMasks& set, const openvdb::CoordBBox& box, Visit&& visit) {
  const openvdb::Coord first = box.min() & ~(kWidth - 1);
  for (int x = first.x(); x <= box.max().x(); x += kWidth) {
    for (int y = first.y(); y <= box.max().y(); y += kWidth) {
      for (int z = first.z(); z <= box.max().z(); z += kWidth) {
        const std::uint32_t number = set.find({x, y, z});
        if (number == LeafIndex::none) continue;
        const NodeMasks::Leaf& leaf = set.leaves()[number];
        for (int i = 0; i < kWidth; ++i) {
          for_each_bit(leaf.words[i], [&](int bit) {
            const openvdb::Coord node = leaf.origin.offsetBy(i, bit >> 3, bit & 7);
            if (box.isInside(node)) visit(node);
          });
        }
      }
    }
  }
}

}  // namespace

std::vector<openvdb::Coord> nodes_beyond_detail(const NodeMasks& set, const MeshLattice& lattice,
                                                const std::vector<float>& delta, double slack) {
  const NodeNumbers numbers(set);
  const double h = lattice.h();
  openvdb::CoordBBox all;
  for (const openvdb::Coord& node : numbers.nodes()) all.expand(node);
  // Threads only ever set a mark, so their order does not matter.
  std::vector<std::atomic<char>> is_explained(numbers.nodes().size());
  const NearVertices near(lattice.positions(), set, h, kUsualReach * h);
  const auto explain = [&](const Triangle& triangle) {
    const double reach = largest_delta(triangle, delta) + slack;
    if (!near.may_be_near(triangle[0]) && reach + longest_edge(lattice.positions(), triangle) <= kUsualReach * h)
      return;
    const Corners corners = corners_of(lattice.positions(), triangle);
    openvdb::CoordBBox box = nodes_around(corners, reach, h);
    box.intersect(all);
    if (box.empty()) return;
    for_each_node_in(set, box, [&](const openvdb::Coord& node) {
      std::atomic<char>& mark = is_explained[numbers.find(node)];
      if (mark.load(std::memory_order_relaxed) != 0) return;
      const openvdb::Vec3d place(lattice.plane(node.x()), lattice.plane(node.y()), lattice.plane(node.z()));
      if (squared_distance(corners, place) <= reach * reach) mark.store(1, std::memory_order_relaxed);
    });
  };
  const std::vector<Triangle>& triangles = lattice.triangles();
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles.size(), 1024), [&](const auto& range) {
    for (std::size_t t = range.begin(); t != range.end(); ++t) explain(triangles[t]);
  });
  std::vector<openvdb::Coord> unexplained;
  for (std::size_t n = 0; n < is_explained.size(); ++n) {
    if (is_explained[n].load(std::memory_order_relaxed) == 0) unexplained.push_back(numbers.nodes()[n]);
  }
  return unexplained;
}

}  // namespace particle_surface_tracker
