#include "cell_complexity.h"

#include <algorithm>

#include "lattice_parts.h"

namespace particle_surface_tracker::remeshing {

namespace {

bool is_sheet_order(int winding) {
  return winding == 0 || winding == 1;
}

bool is_same_line(const LatticeEdge& p, const LatticeEdge& q) {
  const int u = (p.axis + 1) % 3;
  const int v = (p.axis + 2) % 3;
  return p.axis == q.axis && p.node[u] == q.node[u] && p.node[v] == q.node[v];
}

/// Walks along the lattice lines and collects what it sees.
class LineWalk {
 public:
  explicit LineWalk(const GammaNodes& gamma) : gamma_(gamma) {}

  CellComplexity run() {
    const std::vector<EdgeCrossing>& crossings = gamma_.lattice().crossings();
    int winding = 0;
    for (std::size_t begin = 0, end = 0; begin < crossings.size(); begin = end) {
      const LatticeEdge& edge = crossings[begin].edge;
      if (begin == 0 || !is_same_line(edge, crossings[begin - 1].edge)) winding = 0;
      const int before = winding;
      bool overlaps = false;
      for (; end < crossings.size() && crossings[end].edge == edge; ++end) {
        winding += crossings[end].step;
        overlaps = overlaps || !is_sheet_order(winding);
      }
      look_at_edge(edge, before, winding, end - begin, overlaps);
    }
    for (const openvdb::Coord& node : gamma_.changed()) look_at_changed(node);
    result_.near_sign_change.dilate(1, 1);
    return std::move(result_);
  }

 private:
  void look_at_edge(const LatticeEdge& edge, int before, int after, std::size_t crossings, bool overlaps) {
    const openvdb::Coord upper = moved(edge.node, edge.axis, 1);
    if (crossings > 1 || overlaps) {
      for (const openvdb::Coord& cell : cells_around(edge)) {
        result_.complex.insert(cell);
        if (overlaps) result_.tangled.insert(cell);
      }
    }
    if (!is_sheet_order(before)) look_at_complex_node(edge.node);
    if (!is_sheet_order(after)) look_at_complex_node(upper);
    // Edges at nodes with a new sign are looked at afterwards, whether the mesh crosses them or not.
    if ((before >= 1) == (after >= 1) || touches_changed(edge.node, upper)) return;
    insert_cells_around(edge);
  }

  void look_at_complex_node(const openvdb::Coord& node) {
    for (int corner = 0; corner < kCellCorners; ++corner) {
      const openvdb::Coord cell = node - corner_of({0, 0, 0}, corner);
      if (gamma_.lattice().triangles_in_cell(cell).empty()) continue;
      result_.complex.insert(cell);
      result_.tangled.insert(cell);
    }
  }

  bool touches_changed(const openvdb::Coord& a, const openvdb::Coord& b) const {
    return !gamma_.changed().empty() && (gamma_.has_changed(a) || gamma_.has_changed(b));
  }

  void look_at_changed(const openvdb::Coord& node) {
    const bool inside = is_inside(node);
    for (std::uint8_t axis = 0; axis < 3; ++axis) {
      const openvdb::Coord lower = moved(node, axis, -1);
      if (is_inside(moved(node, axis, 1)) != inside) insert_cells_around({node, axis});
      if (is_inside(lower) != inside) insert_cells_around({lower, axis});
    }
  }

  bool is_inside(const openvdb::Coord& node) const {
    return (gamma_.lattice().winding_number(node) >= 1) != gamma_.has_changed(node);
  }

  void insert_cells_around(const LatticeEdge& edge) {
    for (const openvdb::Coord& cell : cells_around(edge)) result_.near_sign_change.insert(cell);
  }

  const GammaNodes& gamma_;
  CellComplexity result_;
};

}  // namespace

CellComplexity classify_cells(const GammaNodes& gamma) {
  return LineWalk(gamma).run();
}

std::vector<openvdb::Coord> find_deep_cells(TriangleCuts& cuts, const NodeMasks& near_sign_change,
                                            const SmallComponents& small) {
  std::vector<openvdb::Coord> deep;
  for (const openvdb::Coord& cell : cuts.lattice().cells_outside(near_sign_change)) {
    const auto triangles = cuts.lattice().triangles_in_cell(cell);
    const bool holds_mesh = std::any_of(triangles.begin(), triangles.end(), [&](std::uint32_t triangle) {
      return !small.contain(triangle) && cuts.meets(triangle, cell);
    });
    if (holds_mesh) deep.push_back(cell);
  }
  std::sort(deep.begin(), deep.end());
  return deep;
}

}  // namespace particle_surface_tracker::remeshing
