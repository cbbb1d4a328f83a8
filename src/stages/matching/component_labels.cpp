#include "component_labels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "particle_surface_tracker/core/vertex_components.h"
#include "stages/nodes/lattice_cell.h"
#include "stages/nodes/node_masks.h"

namespace particle_surface_tracker {

namespace {

/// Cells away from the isosurface up to which it is known what is nearest: as far as details usually reach.
constexpr int kReach = 4;

constexpr int kWidth = 8;  // of a leaf

/// Most components are specks.
constexpr std::size_t kFewLeaves = 8;

/// A component of eight particles has more triangles, where cells are half as large as r.
constexpr std::size_t kLargestSpeck = 150;

/// The components of φ = 0: 0 is the largest, the others count from 1 by their lowest vertex.
struct NumberedComponents {
  std::vector<std::int32_t> of_triangle;
  std::vector<std::size_t> sizes;  ///< [triangles], by number.
};

NumberedComponents number_components(const SurfaceTriangulation& surface) {
  const auto [of_vertex, count] = vertex_components(surface.vertices.size(), surface.triangles);
  std::vector<std::size_t> sizes(count, 0);
  for (const Triangle& t : surface.triangles) ++sizes[of_vertex[t[0]]];
  const auto largest = static_cast<std::size_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  NumberedComponents numbered{std::vector<std::int32_t>(surface.triangles.size()), sizes};
  if (count > 0)
    std::rotate(numbered.sizes.begin(), numbered.sizes.begin() + static_cast<std::ptrdiff_t>(largest),
                numbered.sizes.begin() + static_cast<std::ptrdiff_t>(largest) + 1);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const std::size_t component = of_vertex[surface.triangles[t][0]];
    const std::size_t number = component == largest ? 0 : (component < largest ? component + 1 : component);
    numbered.of_triangle[t] = static_cast<std::int32_t>(number);
  }
  return numbered;
}

/// Of all components but the largest the cut cells, and those of the largest in leaves next to them, by number.
std::vector<NodeMasks> cells_near_gaps(const SurfaceTriangulation& surface, const NumberedComponents& components) {
  std::vector<NodeMasks> cells(components.sizes.size(), NodeMasks(kFewLeaves));
  for (std::size_t c = 0; c + 1 < surface.cells.size(); ++c) {
    cells[components.of_triangle[surface.cells[c].first_triangle]].insert(surface.cells[c].origin);
  }
  NodeMasks around;
  for (std::size_t number = 1; number < cells.size(); ++number) {
    for (const NodeMasks::Leaf& leaf : cells[number].leaves()) {
      for (int n = 0; n < 27; ++n) {
        around.words_at(leaf.origin.offsetBy(kWidth * (n / 9 - 1), kWidth * (n / 3 % 3 - 1), kWidth * (n % 3 - 1)));
      }
    }
  }
  NodeMasks near(kFewLeaves);
  for (const NodeMasks::Leaf& leaf : cells.front().leaves()) {
    if (around.find(leaf.origin) != LeafIndex::none) near.words_at(leaf.origin) = leaf.words;
  }
  cells.front() = std::move(near);
  return cells;
}

}  // namespace

ComponentLabels::ComponentLabels(const ImplicitSurface& surface) : dx_(surface.dx) {
  const NumberedComponents components = number_components(surface.triangulation);
  for (const std::size_t size : components.sizes) is_speck_.push_back(size <= kLargestSpeck);
  if (components.sizes.size() <= 1) return;
  // All components grow by a layer of cells at a time; what two reach at the same time belongs to the first.
  std::vector<NodeMasks> fronts = cells_near_gaps(surface.triangulation, components);
  NodeMasks taken;
  for (int step = 0; step <= kReach; ++step) {
    for (std::size_t number = 0; number < fronts.size(); ++number) {
      NodeMasks& front = fronts[number];
      if (step > 0) front = nodes_beside(front);
      for (const NodeMasks::Leaf& leaf : front.leaves()) {
        LeafWords& taken_words = taken.words_at(leaf.origin);
        LeafWords& words = front.words_at(leaf.origin);
        for (int x = 0; x < kWidth; ++x) words[x] &= ~taken_words[x];
        add_words(words, taken_words);
        add(leaf.origin, words, static_cast<std::int32_t>(number));
      }
    }
  }
}

void ComponentLabels::add(const openvdb::Coord& origin, const LeafWords& cells, std::int32_t number) {
  std::uint32_t leaf = index_.find(origin);
  if (leaf == LeafIndex::none) {
    leaf = static_cast<std::uint32_t>(leaves_.size());
    index_.insert(origin, leaf);
    leaves_.emplace_back().fill(kFar);
  }
  for (int x = 0; x < kWidth; ++x) {
    for_each_bit(cells[x], [&](int bit) { leaves_[leaf][kWidth * kWidth * x + bit] = number; });
  }
}

std::vector<std::int32_t> ComponentLabels::of(const std::vector<Vec3f>& positions) const {
  std::vector<std::int32_t> found(positions.size(), kFar);
  if (is_of_one_piece()) return found;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), 4096), [&](const auto& range) {
    for (std::size_t n = range.begin(); n != range.end(); ++n) {
      const openvdb::Coord cell = cell_of(positions[n].cast<double>() / dx_);
      const std::uint32_t leaf = index_.find(cell & ~(kWidth - 1));
      if (leaf == LeafIndex::none) continue;
      found[n] = leaves_[leaf][kWidth * kWidth * (cell.x() & 7) + kWidth * (cell.y() & 7) + (cell.z() & 7)];
    }
  });
  return found;
}

}  // namespace particle_surface_tracker
