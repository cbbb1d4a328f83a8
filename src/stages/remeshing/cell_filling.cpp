#include "cell_filling.h"

#include <algorithm>

#include "lattice_parts.h"
#include "stages/triangulation/loop_filling.h"

namespace particle_surface_tracker::remeshing {

namespace {

using openvdb::Coord;

/// A part of the border between the surface in a cell and that in the next one, with the cell's part on its left.
struct Link {
  std::uint32_t from;
  std::uint32_t to;
  bool used = false;
};

bool starts_before(const Link& a, const Link& b) {
  return a.from < b.from;
}

class CellFiller {
 public:
  CellFiller(const CellSet& marked, GammaNodes& gamma, FaceTracer& tracer, Patch& patch)
      : marked_(marked), gamma_(gamma), tracer_(tracer), patch_(patch) {}

  bool run() {
    patch_.first_filling = patch_.triangles.size();
    const std::vector<Coord> cells = marked_.sorted();
    return std::all_of(cells.begin(), cells.end(), [&](const Coord& cell) { return fill(cell); });
  }

 private:
  bool fill(const Coord& cell) {
    const unsigned inside = gamma_.inside_corners(cell);
    if (inside == 0 || inside == 255) return true;
    touches_front_ = false;
    if (!find_vertices(cell, inside)) return false;
    // Diagonals are safe only where nothing but other fillings can use them.
    if (!touches_front_) {
      const LoopFilling& filling = loop_fillings()[inside];
      for (int t = 0; t < filling.triangle_count; ++t) {
        const auto& [a, b, c] = filling.triangles[t];
        patch_.triangles.push_back({vertex_on_[a], vertex_on_[b], vertex_on_[c]});
      }
      return true;
    }
    return find_links(cell, inside) && fill_loops(cell);
  }

  /// Finds the vertex on every edge of the cell whose ends have different signs.
  bool find_vertices(const Coord& cell, unsigned inside) {
    for (int edge = 0; edge < kCellEdges; ++edge) {
      vertex_on_[edge] = Patch::none;
      const LatticeEdge on_lattice = edge_of(cell, edge);
      const bool is_front = is_on_front(on_lattice);
      touches_front_ = touches_front_ || is_front;
      if ((inside >> cell_edges()[edge].lower & 1) == (inside >> cell_edges()[edge].upper & 1)) continue;
      vertex_on_[edge] = is_front ? front_vertex_on(on_lattice) : inner_vertex_on(on_lattice);
      if (vertex_on_[edge] == Patch::none) return false;
    }
    return true;
  }

  bool is_on_front(const LatticeEdge& edge) const {
    const auto cells = cells_around(edge);
    return !std::all_of(cells.begin(), cells.end(), [&](const Coord& cell) { return marked_.contains(cell); });
  }

  std::uint32_t front_vertex_on(const LatticeEdge& edge) const {
    const auto crossings = tracer_.lattice().crossings_on(edge);
    if (crossings.size() != 1) return Patch::none;
    LatticePoint point;
    point.kind = LatticePoint::Kind::kOnLatticeEdge;
    point.axis = edge.axis;
    point.node = edge.node;
    point.a = crossings[0].triangle;
    return patch_.find_front_vertex(point);
  }

  std::uint32_t inner_vertex_on(const LatticeEdge& edge) {
    const auto [place, is_new] = inner_.emplace(edge, 0);
    if (is_new) {
      LatticePoint point;
      point.axis = edge.axis;
      point.node = edge.node;
      place->second = patch_.add(PatchVertex::Kind::kEdge, point);
    }
    return place->second;
  }

  /// Collects the kept polylines on front faces and the segments of the table on the others.
  bool find_links(const Coord& cell, unsigned inside) {
    links_.clear();
    for (int face = 0; face < kCellFaces; ++face) {
      if (!marked_.contains(cell_beyond(cell, face))) {
        if (!append_paths(face_of(cell, face), /*is_lower_cell*/ face % 2 == 1)) return false;
        continue;
      }
      const FaceSegments segments = face_segments(face, inside);
      for (int s = 0; s < segments.count; ++s) {
        links_.push_back({vertex_on_[segments.segments[s].from], vertex_on_[segments.segments[s].to]});
      }
    }
    std::sort(links_.begin(), links_.end(), starts_before);
    const auto same_start = [](const Link& a, const Link& b) { return a.from == b.from; };
    return std::adjacent_find(links_.begin(), links_.end(), same_start) == links_.end();
  }

  bool append_paths(const LatticeFace& face, bool is_lower_cell) {
    const FacePaths& on_face = tracer_.paths_on(face);
    if (!on_face.simple) return false;
    for (const std::vector<LatticePoint>& path : on_face.paths) {
      for (std::size_t n = 0; n + 1 < path.size(); ++n) {
        std::uint32_t from = patch_.find_front_vertex(path[n]);
        std::uint32_t to = patch_.find_front_vertex(path[n + 1]);
        if (from == Patch::none || to == Patch::none) return false;
        if (!is_lower_cell) std::swap(from, to);
        links_.push_back({from, to});
      }
    }
    return true;
  }

  /// Chains the links to loops and fills each with a disc.
  bool fill_loops(const Coord& cell) {
    for (Link& first : links_) {
      if (first.used) continue;
      loop_.clear();
      for (Link* link = &first;;) {
        if (link->used) return false;
        link->used = true;
        loop_.push_back(link->from);
        if (link->to == first.from) break;
        const auto next = std::lower_bound(links_.begin(), links_.end(), Link{link->to, link->to}, starts_before);
        if (next == links_.end() || next->from != link->to) return false;
        link = &*next;
      }
      if (loop_.size() < 3) return false;
      fill_loop(cell);
    }
    return true;
  }

  void fill_loop(const Coord& cell) {
    if (loop_.size() == 3) {
      patch_.triangles.push_back({loop_[0], loop_[1], loop_[2]});
      return;
    }
    LatticePoint point;
    point.node = cell;
    const std::uint32_t center = patch_.add(PatchVertex::Kind::kCenter, point);
    for (std::size_t n = 0; n < loop_.size(); ++n) {
      patch_.triangles.push_back({center, loop_[n], loop_[(n + 1) % loop_.size()]});
    }
  }

  const CellSet& marked_;
  GammaNodes& gamma_;
  FaceTracer& tracer_;
  Patch& patch_;
  std::unordered_map<LatticeEdge, std::uint32_t, LatticeHash> inner_;
  std::array<std::uint32_t, kCellEdges> vertex_on_{};
  bool touches_front_ = false;
  std::vector<Link> links_;
  std::vector<std::uint32_t> loop_;
};

}  // namespace

bool fill_cells(const CellSet& marked, GammaNodes& gamma, FaceTracer& tracer, Patch& patch) {
  return CellFiller(marked, gamma, tracer, patch).run();
}

}  // namespace particle_surface_tracker::remeshing
