#include "mesh_cutting.h"

#include <algorithm>

#include <Eigen/Geometry>

#include "front_places.h"
#include "piece_triangulation.h"
#include "triangle_outline.h"

namespace particle_surface_tracker::remeshing {

namespace {

using openvdb::Coord;
using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// A triangle of which a part stays.
struct CutTriangle {
  std::uint32_t triangle;
  TriangleOutline outline;
};

void append_cells(const TriangleCut& cut, std::vector<Coord>& cells) {
  cells.insert(cells.end(), cut.cells.begin(), cut.cells.end());
  for (const TriangleCut::Segment& segment : cut.segments) {
    cells.push_back(segment.face.lower_cell());
    cells.push_back(segment.face.upper_cell());
  }
}

std::vector<std::uint32_t> triangles_in(const MeshLattice& lattice, const CellSet& cells) {
  std::vector<std::uint32_t> triangles;
  for (const Coord& cell : cells.cells()) {
    const auto in_cell = lattice.triangles_in_cell(cell);
    triangles.insert(triangles.end(), in_cell.begin(), in_cell.end());
  }
  std::sort(triangles.begin(), triangles.end());
  triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  return triangles;
}

/// The corners and cut points of a triangle, laid out in its plane.
class FlatTriangle {
 public:
  FlatTriangle(const MeshLattice& lattice, std::uint32_t triangle) {
    const Triangle& t = lattice.triangles()[triangle];
    for (int k = 0; k < 3; ++k) corners_[k] = lattice.positions()[t[k]].cast<double>();
    const Vec3d side = corners_[1] - corners_[0];
    const Vec3d normal = side.cross(corners_[2] - corners_[0]);
    x_ = side.stableNormalized();
    y_ = normal.stableNormalized().cross(x_);
  }

  Eigen::Vector2d at(const Vec3d& position) const {
    const Vec3d d = position - corners_[0];
    return {d.dot(x_), d.dot(y_)};
  }
  Eigen::Vector2d corner(int k) const { return at(corners_[k]); }

 private:
  std::array<Vec3d, 3> corners_;
  Vec3d x_;
  Vec3d y_;
};

class Cutter {
 public:
  Cutter(TriangleCuts& cuts, const CellSet& marked, Patch& patch)
      : cuts_(cuts), lattice_(cuts.lattice()), marked_(marked), patch_(patch) {}

  std::vector<Coord> run() {
    find_outlines();
    if (!trouble_.empty()) return trouble_;
    place_front_vertices(lattice_, patch_);
    for (const CutTriangle& part : parts_) {
      if (!triangulate(part)) append_cells(cuts_.of(part.triangle), trouble_);
    }
    return trouble_;
  }

 private:
  void find_outlines() {
    OutlineTracer tracer(lattice_, marked_);
    for (const std::uint32_t triangle : triangles_in(lattice_, marked_)) {
      const TriangleCut& cut = cuts_.of(triangle);
      TriangleOutline outline = tracer.trace(triangle, cut);
      switch (outline.kind) {
        case TriangleOutline::Kind::kWhole:
          continue;
        case TriangleOutline::Kind::kContradiction:
          append_cells(cut, trouble_);
          continue;
        case TriangleOutline::Kind::kGone:
          break;
        case TriangleOutline::Kind::kPart:
          for (const TriangleOutline::Loop& loop : outline.loops) {
            for (const std::uint32_t v : loop.vertices) {
              if (v < cut.points.size()) patch_.front_vertex(cut.points[v]);
            }
          }
          parts_.push_back({triangle, std::move(outline)});
          break;
      }
      patch_.removed.push_back(triangle);
    }
  }

  bool triangulate(const CutTriangle& part) {
    const TriangleCut& cut = cuts_.of(part.triangle);
    lay_out(part, cut);
    apart_.clear();
    for (const TriangleCut::Segment& segment : cut.segments) {
      if (marked_.contains(segment.face.lower_cell()) || marked_.contains(segment.face.upper_cell())) {
        keep_apart(segment.from, segment.to);
      }
    }
    for (const TriangleOutline::Loop& loop : part.outline.loops) {
      for (std::size_t n = 0; n < loop.vertices.size(); ++n) {
        keep_apart(loop.vertices[n], loop.vertices[(n + 1) % loop.vertices.size()]);
      }
    }
    std::vector<std::uint32_t> pieces;
    for (const TriangleOutline::Loop& loop : part.outline.loops) pieces.push_back(loop.piece);
    std::sort(pieces.begin(), pieces.end());
    pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
    return std::all_of(pieces.begin(), pieces.end(),
                       [&](std::uint32_t piece) { return triangulate(part, cut, piece); });
  }

  bool triangulate(const CutTriangle& part, const TriangleCut& cut, std::uint32_t piece) {
    std::sort(apart_.begin(), apart_.end());
    FlatPiece flat{{}, &places_, &edges_, &apart_};
    for (const TriangleOutline::Loop& loop : part.outline.loops) {
      if (loop.piece == piece) flat.loops.push_back(loop.vertices);
    }
    std::vector<std::array<std::uint32_t, 3>> triangles;
    if (!triangulate_piece(flat, triangles)) return false;
    for (const auto& triangle : triangles) {
      Triangle& added = patch_.triangles.emplace_back();
      for (int k = 0; k < 3; ++k) {
        added[k] = global(part.triangle, cut, triangle[k]);
        keep_apart(triangle[k], triangle[(k + 1) % 3]);
      }
    }
    return true;
  }

  std::uint32_t global(std::uint32_t triangle, const TriangleCut& cut, std::uint32_t v) const {
    if (v < cut.points.size()) return patch_.find_front_vertex(cut.points[v]);
    return lattice_.triangles()[triangle][v - cut.points.size()];
  }

  /// Finds where the vertices of the outline are in the triangle's plane, and on which of its edges.
  void lay_out(const CutTriangle& part, const TriangleCut& cut) {
    const Triangle& corners = lattice_.triangles()[part.triangle];
    const FlatTriangle flat(lattice_, part.triangle);
    const auto point_count = static_cast<std::uint32_t>(cut.points.size());
    places_.resize(point_count + 3);
    edges_.assign(point_count + 3, 0);
    for (const TriangleOutline::Loop& loop : part.outline.loops) {
      for (const std::uint32_t v : loop.vertices) {
        if (v >= point_count) continue;
        const LatticePoint& point = cut.points[v];
        places_[v] = flat.at(patch_.vertex(patch_.find_front_vertex(point)).position);
        if (point.kind == LatticePoint::Kind::kOnLatticeFace) edges_[v] = edge_bit(corners, point);
      }
    }
    for (int k = 0; k < 3; ++k) {
      places_[point_count + k] = flat.corner(k);
      edges_[point_count + k] = static_cast<std::uint8_t>(1 << k | 1 << (k + 2) % 3);
    }
  }

  static std::uint8_t edge_bit(const Triangle& corners, const LatticePoint& point) {
    for (int k = 0; k < 3; ++k) {
      if (std::minmax(corners[k], corners[(k + 1) % 3]) == std::minmax(point.a, point.b)) {
        return static_cast<std::uint8_t>(1 << k);
      }
    }
    return 0;
  }

  void keep_apart(std::uint32_t a, std::uint32_t b) { apart_.emplace_back(std::min(a, b), std::max(a, b)); }

  TriangleCuts& cuts_;
  const MeshLattice& lattice_;
  const CellSet& marked_;
  Patch& patch_;
  std::vector<CutTriangle> parts_;
  std::vector<Coord> trouble_;
  std::vector<Eigen::Vector2d> places_;
  std::vector<std::uint8_t> edges_;
  std::vector<Pair> apart_;
};

}  // namespace

std::vector<Coord> cut_mesh(TriangleCuts& cuts, const CellSet& marked, Patch& patch) {
  return Cutter(cuts, marked, patch).run();
}

}  // namespace particle_surface_tracker::remeshing
