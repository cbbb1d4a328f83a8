#include "component_labels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <openvdb/tree/ValueAccessor.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "particle_surface_tracker/core/mesh_measures.h"
#include "stages/nodes/lattice_cell.h"

namespace particle_surface_tracker {

namespace {

using openvdb::Coord;
using LabelledCell = std::pair<Coord, std::int32_t>;

/// Cells away from the isosurface up to which it is known what is nearest: as far as details usually reach.
constexpr int kReach = 4;

constexpr int kCellsPerLeaf = 8;

/// A component of eight particles has more triangles, where cells are half as large as r.
constexpr std::size_t kLargestSpeck = 150;

/// The components of φ = 0: 0 is the largest, the others count from 1 by their lowest vertex.
struct NumberedComponents {
  std::vector<std::int32_t> of_triangle;
  std::vector<std::size_t> sizes;  ///< [triangles], by number.
};

NumberedComponents number_components(const SurfaceTriangulation& surface) {
  std::size_t count = 0;
  const std::vector<std::uint32_t> of_vertex = vertex_components(surface.vertices.size(), surface.triangles, count);
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

/// Cut cells of all components but the largest, and those of the largest in leaves next to them.
std::vector<LabelledCell> cells_near_gaps(const SurfaceTriangulation& surface,
                                          const std::vector<std::int32_t>& numbers) {
  openvdb::MaskTree near;
  for (std::size_t c = 0; c + 1 < surface.cells.size(); ++c) {
    if (numbers[surface.cells[c].first_triangle] == 0) continue;
    const Coord& origin = surface.cells[c].origin;
    near.touchLeaf(origin);
  }
  openvdb::MaskTree around;
  for (auto leaf = near.cbeginLeaf(); leaf; ++leaf) {
    for (int x = -1; x <= 1; ++x) {
      for (int y = -1; y <= 1; ++y) {
        for (int z = -1; z <= 1; ++z) {
          around.touchLeaf(leaf->origin().offsetBy(kCellsPerLeaf * x, kCellsPerLeaf * y, kCellsPerLeaf * z));
        }
      }
    }
  }
  std::vector<LabelledCell> cells;
  for (std::size_t c = 0; c + 1 < surface.cells.size(); ++c) {
    const CutCell& cell = surface.cells[c];
    if (around.probeConstLeaf(cell.origin) == nullptr) continue;
    cells.emplace_back(cell.origin, numbers[cell.first_triangle] + 1);
  }
  return cells;
}

/// Keeps one label a cell, the lowest.
void settle(std::vector<LabelledCell>& cells) {
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end(), [](const auto& a, const auto& b) { return a.first == b.first; }),
              cells.end());
}

}  // namespace

ComponentLabels::ComponentLabels(const ImplicitSurface& surface) : dx_(surface.dx), labels_(0) {
  const NumberedComponents components = number_components(surface.triangulation);
  for (const std::size_t size : components.sizes) is_speck_.push_back(size <= kLargestSpeck);
  if (components.sizes.size() <= 1) return;
  openvdb::tree::ValueAccessor<openvdb::Int32Tree> labels(labels_);
  std::vector<LabelledCell> front = cells_near_gaps(surface.triangulation, components.of_triangle);
  settle(front);
  for (int step = 0; step <= kReach; ++step) {
    for (const auto& [cell, label] : front) labels.setValue(cell, label);
    std::vector<LabelledCell> next;
    for (const auto& [cell, label] : front) {
      for (int side = 0; side < 6; ++side) {
        Coord beyond = cell;
        beyond[side / 2] += side % 2 == 0 ? -1 : 1;
        if (labels.getValue(beyond) == 0) next.emplace_back(beyond, label);
      }
    }
    settle(next);
    front = std::move(next);
  }
}

std::vector<std::int32_t> ComponentLabels::of(const std::vector<Vec3f>& positions) const {
  std::vector<std::int32_t> found(positions.size(), kFar);
  if (is_of_one_piece()) return found;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), 4096), [&](const auto& range) {
    const openvdb::tree::ValueAccessor<const openvdb::Int32Tree> labels(labels_);
    for (std::size_t n = range.begin(); n != range.end(); ++n) {
      found[n] = labels.getValue(cell_of(positions[n].cast<double>() / dx_)) - 1;
    }
  });
  return found;
}

}  // namespace particle_surface_tracker
