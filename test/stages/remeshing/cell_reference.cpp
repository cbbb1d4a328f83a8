#include "cell_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/intersections.h>

#include "sequences/solid_judge.h"

namespace particle_surface_tracker::test {

namespace {

using openvdb::Coord;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Cells = std::set<Coord>;

Coord step_along(int axis) {
  return {axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0};
}

struct Crossing {
  double place;
  int step;
  std::uint32_t triangle;
};

/// What the mesh does on the square of four lattice edges.
struct Square {
  std::vector<std::uint32_t> triangles;
  bool is_simple = true;
};

class Search {
 public:
  Search(const TriangleMesh& mesh, double h, const RemeshingRequest& request)
      : mesh_(mesh), h_(h), request_(request), judge_(mesh.positions(), mesh.triangles()) {
    for (const Vec3f& p : mesh.positions()) {
      for (int axis = 0; axis < 3; ++axis) {
        const int cell = static_cast<int>(std::floor(p[axis] / h));
        lower_[axis] = std::min(lower_[axis], cell - 2);
        upper_[axis] = std::max(upper_[axis], cell + 3);
      }
    }
    for (const auto& [a, b, c] : mesh.triangles()) triangles_.emplace_back(point(a), point(b), point(c));
    for (std::size_t n = 0; n < request.nodes.size(); ++n) {
      if ((request.gamma[n] < 0.0F) != (winding(request.nodes[n]) >= 1)) changed_.insert(request.nodes[n]);
    }
  }

  TopologyCells run() {
    find_complex();
    find_deep();
    Cells marked(request_.flagged_cells.begin(), request_.flagged_cells.end());
    const Cells flagged = marked;
    for (const Coord& node : changed_) {
      for (const Coord& cell : cells_at(node)) marked.insert(cell);
    }
    marked.insert(tangled_.begin(), tangled_.end());
    marked.insert(deep_.begin(), deep_.end());
    while (grow(marked)) {
    }
    Cells front;
    for (const Coord& cell : marked) {
      if (is_at_front(cell, marked)) front.insert(cell);
    }
    TopologyCells cells;
    cells.cell_size = h_;
    cells.flagged = list(flagged);
    cells.complex = list(complex_);
    cells.tangled = list(tangled_);
    cells.deep = list(deep_);
    cells.marked = list(marked);
    cells.front = list(front);
    cells.changed_nodes = list(changed_);
    return cells;
  }

 private:
  static std::vector<Coord> list(const Cells& cells) { return {cells.begin(), cells.end()}; }

  Point point(std::uint32_t vertex) const {
    const Vec3f& p = mesh_.positions()[vertex];
    return Point(p.x(), p.y(), p.z());
  }

  Point place(const Coord& node) const { return Point(node.x() * h_, node.y() * h_, node.z() * h_); }

  template <typename Visit>
  void for_all(Visit&& visit) const {
    for (int x = lower_.x(); x <= upper_.x(); ++x) {
      for (int y = lower_.y(); y <= upper_.y(); ++y) {
        for (int z = lower_.z(); z <= upper_.z(); ++z) visit(Coord(x, y, z));
      }
    }
  }

  int winding(const Coord& node) {
    const auto [at, is_new] = windings_.try_emplace(node, 0);
    if (is_new) {
      at->second = judge_.winding_number(Vec3f(static_cast<float>(node.x() * h_), static_cast<float>(node.y() * h_),
                                               static_cast<float>(node.z() * h_)));
    }
    return at->second;
  }

  bool is_inside(const Coord& node) { return (winding(node) >= 1) != (changed_.count(node) > 0); }

  static std::array<Coord, 8> cells_at(const Coord& node) {
    std::array<Coord, 8> cells;
    for (int n = 0; n < 8; ++n) cells[n] = node.offsetBy(-(n & 1), -(n >> 1 & 1), -(n >> 2));
    return cells;
  }

  static std::array<Coord, 4> cells_around(const Coord& node, int axis) {
    const Coord u = step_along((axis + 1) % 3);
    const Coord v = step_along((axis + 2) % 3);
    return {node, node - u, node - v, node - u - v};
  }

  bool holds_mesh(const Coord& cell) const {
    const Kernel::Iso_cuboid_3 box(place(cell), place(cell.offsetBy(1)));
    return std::any_of(triangles_.begin(), triangles_.end(), [&](const Kernel::Triangle_3& triangle) {
      return CGAL::do_overlap(triangle.bbox(), box.bbox()) && CGAL::do_intersect(triangle, box);
    });
  }

  std::vector<Crossing> crossings_on(const Coord& node, int axis) const {
    std::vector<Crossing> crossings;
    const Kernel::Segment_3 edge(place(node), place(node + step_along(axis)));
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      const Kernel::Triangle_3& triangle = triangles_[t];
      if (!CGAL::do_overlap(triangle.bbox(), edge.bbox()) || !CGAL::do_intersect(triangle, edge)) continue;
      const Kernel::Vector_3 normal = CGAL::normal(triangle[0], triangle[1], triangle[2]);
      const double along = normal * (edge.target() - edge.source());
      crossings.push_back({normal * (triangle[0] - edge.source()) / along, along < 0.0 ? 1 : -1, t});
    }
    std::sort(crossings.begin(), crossings.end(),
              [](const Crossing& a, const Crossing& b) { return a.place < b.place; });
    return crossings;
  }

  void find_complex() {
    Cells ends;
    for_all([&](const Coord& node) {
      for (int axis = 0; axis < 3; ++axis) {
        const std::vector<Crossing> crossings = crossings_on(node, axis);
        if (crossings.empty()) continue;
        int around = winding(node);
        bool overlaps = false;
        for (const Crossing& crossing : crossings) {
          around += crossing.step;
          overlaps = overlaps || around < 0 || around > 1;
        }
        for (const Coord& end : {node, node + step_along(axis)}) {
          if (winding(end) < 0 || winding(end) > 1) ends.insert(end);
        }
        if (crossings.size() < 2 && !overlaps) continue;
        for (const Coord& cell : cells_around(node, axis)) {
          complex_.insert(cell);
          if (overlaps) tangled_.insert(cell);
        }
      }
    });
    for (const Coord& node : ends) {
      for (const Coord& cell : cells_at(node)) {
        if (!holds_mesh(cell)) continue;
        complex_.insert(cell);
        tangled_.insert(cell);
      }
    }
  }

  void find_deep() {
    for_all([&](const Coord& cell) {
      int inside = 0;
      for (int n = 0; n < 64; ++n) inside += is_inside(cell.offsetBy((n & 3) - 1, (n >> 2 & 3) - 1, (n >> 4) - 1));
      if ((inside == 0 || inside == 64) && holds_mesh(cell)) deep_.insert(cell);
    });
  }

  /// The square across an axis whose lowest corner is a node.
  Square square(const Coord& node, int axis) const {
    const Coord u = step_along((axis + 1) % 3);
    const Coord v = step_along((axis + 2) % 3);
    const std::array<Kernel::Triangle_3, 2> halves = {
        Kernel::Triangle_3(place(node), place(node + u), place(node + v)),
        Kernel::Triangle_3(place(node + u + v), place(node + u), place(node + v))};
    const auto meets = [&](const auto& part) {
      return CGAL::do_intersect(part, halves[0]) || CGAL::do_intersect(part, halves[1]);
    };
    const CGAL::Bbox_3 box = halves[0].bbox() + halves[1].bbox();
    Square found;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> edges;
    std::map<std::uint32_t, std::uint32_t> path;  // by triangle, one of those on the same path
    const auto first_of = [&path](std::uint32_t t) {
      while (path[t] != t) t = path[t];
      return t;
    };
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (!CGAL::do_overlap(triangles_[t].bbox(), box) || !meets(triangles_[t])) continue;
      found.triangles.push_back(t);
      path[t] = t;
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = mesh_.triangles()[t][k];
        const std::uint32_t b = mesh_.triangles()[t][(k + 1) % 3];
        if (!meets(Kernel::Segment_3(point(a), point(b)))) continue;
        const auto [at, is_new] = edges.try_emplace(std::minmax(a, b), t);
        if (!is_new) path[first_of(t)] = first_of(at->second);
      }
    }
    std::set<std::uint32_t> open;
    for (const auto& [corner, along] : {std::pair{node, (axis + 1) % 3}, std::pair{node, (axis + 2) % 3},
                                        std::pair{node + v, (axis + 1) % 3}, std::pair{node + u, (axis + 2) % 3}}) {
      const std::vector<Crossing> crossings = crossings_on(corner, along);
      found.is_simple = found.is_simple && crossings.size() < 2;
      for (const Crossing& crossing : crossings) open.insert(first_of(crossing.triangle));
    }
    for (const std::uint32_t t : found.triangles) found.is_simple = found.is_simple && open.count(first_of(t)) > 0;
    return found;
  }

  /// Calls visit(cell beyond, square, its node, axis) for the faces of a cell at which a set of cells ends.
  template <typename Visit>
  void for_faces_at_rim(const Coord& cell, const Cells& marked, Visit&& visit) const {
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        const Coord beyond = side == 0 ? cell - step_along(axis) : cell + step_along(axis);
        const Coord node = side == 0 ? cell : beyond;
        if (marked.count(beyond) == 0) visit(beyond, square(node, axis), node, axis);
      }
    }
  }

  bool grow(Cells& marked) const {
    Cells more;
    for (const Coord& cell : marked) {
      for_faces_at_rim(cell, marked, [&](const Coord& beyond, const Square& on_face, const Coord& node, int axis) {
        if (!on_face.is_simple) more.insert(beyond);
        const Coord u = step_along((axis + 1) % 3);
        const Coord v = step_along((axis + 2) % 3);
        for (const auto& [corner, along] : {std::pair{node, (axis + 1) % 3}, std::pair{node, (axis + 2) % 3},
                                            std::pair{node + v, (axis + 1) % 3}, std::pair{node + u, (axis + 2) % 3}}) {
          if (crossings_on(corner, along).size() < 2) continue;
          for (const Coord& around : cells_around(corner, along)) more.insert(around);
        }
      });
    }
    const std::size_t before = marked.size();
    marked.insert(more.begin(), more.end());
    return marked.size() > before;
  }

  bool is_at_front(const Coord& cell, const Cells& marked) const {
    bool found = false;
    for_faces_at_rim(cell, marked, [&](const Coord&, const Square& on_face, const Coord&, int) {
      found = found || !on_face.triangles.empty();
    });
    return found;
  }

  const TriangleMesh& mesh_;
  double h_;
  const RemeshingRequest& request_;
  SolidJudge judge_;
  Coord lower_ = Coord::max();
  Coord upper_ = Coord::min();
  std::vector<Kernel::Triangle_3> triangles_;
  std::map<Coord, int> windings_;
  Cells changed_;
  Cells complex_;
  Cells tangled_;
  Cells deep_;
};

}  // namespace

TopologyCells find_cells_by_force(const TriangleMesh& mesh, double h, const RemeshingRequest& request) {
  return Search(mesh, h, request).run();
}

}  // namespace particle_surface_tracker::test
