#include "particle_surface_tracker/stages/surface_triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "cell_loops.h"
#include "cut_cells.h"
#include "edge_numbers.h"
#include "loop_filling.h"

namespace particle_surface_tracker {

namespace {

using openvdb::Coord;

/// A vertex is never closer to a node than this part of the edge.
constexpr double kClosestToNode = 0.001;

/// Nor than so many steps of the floats that positions are stored in: far from the origin these are long, and vertices
/// on several edges of a node would fall on one place.
constexpr double kClosestSteps = 2.0;

/// The distance between floats at a coordinate, in its unit.
double resolution(double coordinate) {
  return std::abs(coordinate) * static_cast<double>(std::numeric_limits<float>::epsilon());
}

/// Where each leaf's part of the output begins.
struct Begin {
  std::uint32_t cell = 0;
  std::uint32_t vertex = 0;
  std::uint32_t triangle = 0;
};

/// Bits that are set; without a library call on plain x86-64.
std::uint32_t count_bits(std::uint64_t word) {
  word -= word >> 1 & 0x5555555555555555;
  word = (word & 0x3333333333333333) + (word >> 2 & 0x3333333333333333);
  word = (word + (word >> 4)) & 0x0F0F0F0F0F0F0F0F;
  return static_cast<std::uint32_t>(word * 0x0101010101010101 >> 56);
}

/// Per axis and slice of a leaf the vertices on its edges before, in the order in which they are placed.
using EdgesBefore = std::array<std::array<std::uint16_t, 8>, 3>;

EdgesBefore count_edges_before(const CutLeaf& leaf) {
  EdgesBefore before;
  std::uint32_t count = 0;
  for (int axis = 0; axis < 3; ++axis) {
    for (int x = 0; x < 8; ++x) {
      before[axis][x] = static_cast<std::uint16_t>(count);
      count += count_bits(leaf.edges[axis][x]);
    }
  }
  return before;
}

/// A node of a cell, as a leaf and an offset into it.
struct NodePlace {
  int neighbor;  ///< 0 for the leaf of the cell, else the one ahead along x, y, z (bits 0, 1, 2).
  int offset;
};

NodePlace corner_place(int cell_offset, int corner) {
  const int x = (cell_offset >> 6) + (corner & 1);
  const int y = (cell_offset >> 3 & 7) + (corner >> 1 & 1);
  const int z = (cell_offset & 7) + (corner >> 2);
  return {x >> 3 | y >> 3 << 1 | z >> 3 << 2, (x & 7) << 6 | (y & 7) << 3 | (z & 7)};
}

class Triangulator {
 public:
  Triangulator(const openvdb::FloatTree& tree, double dx);
  SurfaceTriangulation run();

 private:
  void place_vertices(std::size_t number);
  void fill_cells(std::size_t number);
  void number_edges(std::size_t number, EdgeNumbers& numbers) const;

  double dx_;
  CutCells cut_;
  std::vector<Begin> begin_;
  std::vector<EdgesBefore> edges_before_;
  SurfaceTriangulation surface_;
};

Triangulator::Triangulator(const openvdb::FloatTree& tree, double dx) : dx_(dx), cut_(tree) {}

SurfaceTriangulation Triangulator::run() {
  Begin end;
  begin_.reserve(cut_.leaves().size());
  edges_before_.reserve(cut_.leaves().size());
  for (const CutLeaf& leaf : cut_.leaves()) {
    begin_.push_back(end);
    edges_before_.push_back(count_edges_before(leaf));
    end.cell += leaf.cell_count;
    end.vertex += leaf.edge_count;
    end.triangle += leaf.triangle_count;
  }
  surface_.vertices.resize(end.vertex);
  surface_.triangles.resize(end.triangle);
  surface_.cells.resize(end.cell + 1);
  surface_.cells.back().first_triangle = end.triangle;
  cut_.for_each_leaf([&](std::size_t n) { place_vertices(n); });
  cut_.for_each_leaf([&](std::size_t n) { fill_cells(n); });
  return std::move(surface_);
}

void Triangulator::place_vertices(std::size_t number) {
  const CutLeaf& leaf = cut_.leaves()[number];
  const Coord& origin = leaf.leaf->origin();
  Vec3f* next = surface_.vertices.data() + begin_[number].vertex;
  for (int axis = 0; axis < 3; ++axis) {
    for (int x = 0; x < 8; ++x) {
      for_each_bit(leaf.edges[axis][x], [&](int bit) {
        const int offset = 64 * x + bit;
        const NodePlace upper = corner_place(offset, 1 << axis);
        const double a = leaf.leaf->buffer().data()[offset];
        const double b = cut_.leaves()[leaf.neighbors[upper.neighbor]].leaf->buffer().data()[upper.offset];
        Vec3d node(origin.x() + x, origin.y() + (bit >> 3), origin.z() + (bit & 7));
        const double closest = std::max(kClosestToNode, kClosestSteps * resolution(node[axis]));
        const double t = std::clamp(a / (a - b), closest, std::max(closest, 1.0 - closest));
        node[axis] += t;
        *next++ = (dx_ * node).cast<float>();
      });
    }
  }
}

void Triangulator::number_edges(std::size_t number, EdgeNumbers& numbers) const {
  const CutLeaf& leaf = cut_.leaves()[number];
  for (int n = 0; n < 8; ++n) {
    const std::uint32_t owner = leaf.neighbors[n];
    if (owner == LeafIndex::none) continue;
    // Of the leaves ahead only those nodes that are corners of cells of this one.
    const std::uint64_t rows = (n & 2 ? 0xFFull : ~0ull) & (n & 4 ? kLowestZ : ~0ull);
    for (int axis = 0; axis < 3; ++axis) {
      for (int x = 0; x < (n & 1 ? 1 : 8); ++x) {
        const std::uint64_t edges = cut_.leaves()[owner].edges[axis][x];
        const std::uint32_t first = begin_[owner].vertex + edges_before_[owner][axis][x];
        for_each_bit(edges & rows, [&](int bit) {
          const std::uint64_t below = (std::uint64_t{1} << bit) - 1;
          numbers.set(axis, 8 * (n & 1) + x, 8 * (n >> 1 & 1) + (bit >> 3), 8 * (n >> 2) + (bit & 7),
                      first + count_bits(edges & below));
        });
      }
    }
  }
}

void Triangulator::fill_cells(std::size_t number) {
  const CutLeaf& leaf = cut_.leaves()[number];
  const std::uint8_t* patterns = cut_.patterns(number);
  const std::array<LoopFilling, 256>& fillings = loop_fillings();
  CutCell* cell = surface_.cells.data() + begin_[number].cell;
  std::uint32_t triangle = begin_[number].triangle;
  EdgeNumbers numbers;
  number_edges(number, numbers);
  for (int x = 0; x < 8; ++x) {
    for_each_bit(leaf.cells[x], [&](int bit) {
      *cell++ = {leaf.leaf->origin().offsetBy(x, bit >> 3, bit & 7), triangle};
      const int place = EdgeNumbers::cell_place(x, bit >> 3, bit & 7);
      const LoopFilling& filling = fillings[patterns[64 * x + bit]];
      for (int t = 0; t < filling.triangle_count; ++t) {
        const auto& [a, b, c] = filling.triangles[t];
        surface_.triangles[triangle++] = {numbers.at(place, a), numbers.at(place, b), numbers.at(place, c)};
      }
    });
  }
}

}  // namespace

SurfaceTriangulation triangulate_zero_level(const openvdb::FloatGrid& field, double dx) {
  if (!field.tree().hasActiveTiles()) return Triangulator(field.tree(), dx).run();
  openvdb::FloatTree all_in_leaves(field.tree());
  all_in_leaves.voxelizeActiveTiles();
  return Triangulator(all_in_leaves, dx).run();
}

}  // namespace particle_surface_tracker
