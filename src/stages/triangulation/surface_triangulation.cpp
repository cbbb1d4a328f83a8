#include "particle_surface_tracker/stages/surface_triangulation.h"

#include <algorithm>
#include <memory>

#include "cell_loops.h"
#include "cut_cells.h"
#include "loop_filling.h"

namespace particle_surface_tracker {

namespace {

using openvdb::Coord;

/// A vertex is never closer to a node than this part of the edge.
constexpr double kClosestToNode = 0.001;

/// Where each leaf's part of the output begins.
struct Begin {
  std::uint32_t cell = 0;
  std::uint32_t vertex = 0;
  std::uint32_t triangle = 0;
};

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
  std::uint16_t* vertices_on_edges(std::size_t leaf) const { return vertex_on_edge_.get() + 3 * 512 * leaf; }

  void place_vertices(std::size_t number);
  void fill_cells(std::size_t number);
  std::uint32_t vertex_on(const CutLeaf& leaf, int cell_offset, int edge) const;

  double dx_;
  CutCells cut_;
  std::vector<Begin> begin_;
  /// Per leaf, axis and lower node the number of the vertex on the edge, counted from the leaf's first; set where it is
  /// cut.
  std::unique_ptr<std::uint16_t[]> vertex_on_edge_;
  SurfaceTriangulation surface_;
};

Triangulator::Triangulator(const openvdb::FloatTree& tree, double dx)
    : dx_(dx), cut_(tree), vertex_on_edge_(new std::uint16_t[3 * 512 * cut_.leaves().size()]) {}

SurfaceTriangulation Triangulator::run() {
  Begin end;
  for (const CutLeaf& leaf : cut_.leaves()) {
    begin_.push_back(end);
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
  std::uint16_t* on_edge = vertices_on_edges(number);
  std::uint16_t count = 0;
  Vec3f* vertices = surface_.vertices.data() + begin_[number].vertex;
  for (int axis = 0; axis < 3; ++axis) {
    for (int x = 0; x < 8; ++x) {
      for_each_bit(leaf.edges[axis][x], [&](int bit) {
        const int offset = 64 * x + bit;
        const NodePlace upper = corner_place(offset, 1 << axis);
        const double a = leaf.leaf->buffer().data()[offset];
        const double b = cut_.leaves()[leaf.neighbors[upper.neighbor]].leaf->buffer().data()[upper.offset];
        const double t = std::clamp(a / (a - b), kClosestToNode, 1.0 - kClosestToNode);
        Vec3d node(origin.x() + x, origin.y() + (bit >> 3), origin.z() + (bit & 7));
        node[axis] += t;
        on_edge[512 * axis + offset] = count;
        vertices[count++] = (dx_ * node).cast<float>();
      });
    }
  }
}

std::uint32_t Triangulator::vertex_on(const CutLeaf& leaf, int cell_offset, int edge) const {
  const CellEdge& e = cell_edges()[edge];
  const NodePlace lower = corner_place(cell_offset, e.lower);
  const std::uint32_t owner = leaf.neighbors[lower.neighbor];
  return begin_[owner].vertex + vertices_on_edges(owner)[512 * e.axis + lower.offset];
}

void Triangulator::fill_cells(std::size_t number) {
  const CutLeaf& leaf = cut_.leaves()[number];
  const std::uint8_t* patterns = cut_.patterns(number);
  CutCell* cell = surface_.cells.data() + begin_[number].cell;
  std::uint32_t triangle = begin_[number].triangle;
  std::array<std::uint32_t, kCellEdges> vertex_on_edge;
  for (int x = 0; x < 8; ++x) {
    for_each_bit(leaf.cells[x], [&](int bit) {
      const int offset = 64 * x + bit;
      *cell++ = {leaf.leaf->origin().offsetBy(x, bit >> 3, bit & 7), triangle};
      const CellLoops& loops = cell_loops()[patterns[offset]];
      for (int p = 0; p < loops.begin[loops.count]; ++p) {
        vertex_on_edge[loops.edge[p]] = vertex_on(leaf, offset, loops.edge[p]);
      }
      const LoopFilling& filling = loop_fillings()[patterns[offset]];
      for (int t = 0; t < filling.triangle_count; ++t) {
        const auto& [a, b, c] = filling.triangles[t];
        surface_.triangles[triangle++] = {vertex_on_edge[a], vertex_on_edge[b], vertex_on_edge[c]};
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
