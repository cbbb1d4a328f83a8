#include "triangle_outline.h"

#include <algorithm>
#include <numeric>

namespace particle_surface_tracker::remeshing {

namespace {

constexpr std::uint32_t kNone = 0xffffffff;

}  // namespace

TriangleOutline OutlineTracer::trace(std::uint32_t triangle, const TriangleCut& cut) {
  cells_.clear();
  half_edges_.clear();
  TriangleOutline outline;
  if (!find_half_edges(lattice_.triangles()[triangle], cut)) {
    outline.kind = TriangleOutline::Kind::kContradiction;
    return outline;
  }
  is_marked_.resize(cells_.size());
  for (std::size_t c = 0; c < cells_.size(); ++c) is_marked_[c] = marked_.contains(cells_[c]) ? 1 : 0;
  const auto marked_count = std::count(is_marked_.begin(), is_marked_.end(), 1);
  if (marked_count == 0) return outline;
  outline.kind = TriangleOutline::Kind::kGone;
  if (static_cast<std::size_t>(marked_count) == cells_.size()) return outline;
  outline.kind = follow_outlines(cut, outline) ? TriangleOutline::Kind::kPart : TriangleOutline::Kind::kContradiction;
  return outline;
}

bool OutlineTracer::find_half_edges(const Triangle& triangle, const TriangleCut& cut) {
  leaving_.resize(std::max(leaving_.size(), cut.points.size() + 3));
  for (std::size_t v = 0; v < cut.points.size() + 3; ++v) leaving_[v].clear();
  for (const TriangleCut::Segment& segment : cut.segments) {
    const auto first = static_cast<std::uint32_t>(half_edges_.size());
    add(segment.from, segment.to, add_cell(segment.face.lower_cell()), first + 1);
    add(segment.to, segment.from, add_cell(segment.face.upper_cell()), first);
  }
  for (int corner = 0; corner < 3; ++corner) {
    if (!follow_edge(corner, triangle, cut)) return false;
  }
  return true;
}

bool OutlineTracer::follow_edge(int corner, const Triangle& triangle, const TriangleCut& cut) {
  const auto first_corner = static_cast<std::uint32_t>(cut.points.size());
  const int next_corner = (corner + 1) % 3;
  std::uint32_t at = first_corner + corner;
  openvdb::Coord cell = cut.cells[corner];
  for (const std::uint32_t point : points_on_edge(triangle[corner], triangle[next_corner], cut)) {
    const LatticePoint& p = cut.points[point];
    const LatticeFace face{p.node, p.axis};
    add(at, point, add_cell(cell), kNone);
    if (cell == face.lower_cell()) {
      cell = face.upper_cell();
    } else if (cell == face.upper_cell()) {
      cell = face.lower_cell();
    } else {
      return false;
    }
    at = point;
  }
  add(at, first_corner + next_corner, add_cell(cell), kNone);
  return cell == cut.cells[next_corner];
}

std::vector<std::uint32_t> OutlineTracer::points_on_edge(std::uint32_t from, std::uint32_t to,
                                                         const TriangleCut& cut) const {
  const auto [low, high] = std::minmax(from, to);
  std::vector<std::uint32_t> points;
  for (std::uint32_t n = 0; n < cut.points.size(); ++n) {
    const LatticePoint& p = cut.points[n];
    if (p.kind == LatticePoint::Kind::kOnLatticeFace && p.a == low && p.b == high) points.push_back(n);
  }
  std::sort(points.begin(), points.end(), [&](std::uint32_t m, std::uint32_t n) {
    return from < to ? lattice_.comes_before(cut.points[m], cut.points[n])
                     : lattice_.comes_before(cut.points[n], cut.points[m]);
  });
  return points;
}

std::uint32_t OutlineTracer::add_cell(const openvdb::Coord& cell) {
  // From the back: what follows each other along a triangle's edge or in the list of segments is near.
  const auto found = std::find(cells_.rbegin(), cells_.rend(), cell);
  if (found != cells_.rend()) return static_cast<std::uint32_t>(cells_.rend() - found - 1);
  cells_.push_back(cell);
  return static_cast<std::uint32_t>(cells_.size() - 1);
}

void OutlineTracer::add(std::uint32_t from, std::uint32_t to, std::uint32_t cell, std::uint32_t twin) {
  leaving_[from].push_back(static_cast<std::uint32_t>(half_edges_.size()));
  half_edges_.push_back({from, to, cell, twin});
}

std::uint32_t OutlineTracer::leaving(std::uint32_t vertex, std::uint32_t cell) const {
  for (const std::uint32_t e : leaving_[vertex]) {
    if (half_edges_[e].cell == cell) return e;
  }
  return kNone;
}

bool OutlineTracer::is_outline(const HalfEdge& e) const {
  return is_marked_[e.cell] == 0 && (e.twin == kNone || is_marked_[half_edges_[e.twin].cell] != 0);
}

/// Turns round the end of a half-edge, from kept cell to kept cell, up to the next outline.
std::uint32_t OutlineTracer::next_on_outline(std::uint32_t half_edge) const {
  const std::uint32_t vertex = half_edges_[half_edge].to;
  std::uint32_t cell = half_edges_[half_edge].cell;
  for (std::size_t turns = 0; turns <= leaving_[vertex].size(); ++turns) {
    const std::uint32_t next = leaving(vertex, cell);
    if (next == kNone || is_outline(half_edges_[next])) return next;
    cell = half_edges_[half_edges_[next].twin].cell;
  }
  return kNone;
}

bool OutlineTracer::follow_outlines(const TriangleCut& cut, TriangleOutline& outline) const {
  const std::vector<std::uint32_t> pieces = find_pieces();
  const auto is_front = [&](std::uint32_t vertex) {
    if (vertex >= cut.points.size() || cut.points[vertex].kind == LatticePoint::Kind::kOnLatticeEdge) return true;
    // A point on a face ends one segment; where both its sides are kept, the triangle's edge just goes on.
    return std::any_of(leaving_[vertex].begin(), leaving_[vertex].end(), [&](std::uint32_t e) {
      const HalfEdge& half_edge = half_edges_[e];
      return half_edge.twin != kNone && is_marked_[half_edge.cell] + is_marked_[half_edges_[half_edge.twin].cell] == 1;
    });
  };
  std::vector<char> done(half_edges_.size(), 0);
  for (std::uint32_t first = 0; first < half_edges_.size(); ++first) {
    if (done[first] != 0 || !is_outline(half_edges_[first])) continue;
    TriangleOutline::Loop loop;
    loop.piece = pieces[half_edges_[first].cell];
    for (std::uint32_t e = first; done[e] == 0;) {
      done[e] = 1;
      if (is_front(half_edges_[e].to)) loop.vertices.push_back(half_edges_[e].to);
      e = next_on_outline(e);
      if (e == kNone || (done[e] != 0 && e != first)) return false;
    }
    if (loop.vertices.size() < 3) return false;
    outline.loops.push_back(std::move(loop));
  }
  return !outline.loops.empty();
}

/// Numbers the connected kept pieces; one number per cell.
std::vector<std::uint32_t> OutlineTracer::find_pieces() const {
  std::vector<std::uint32_t> piece(cells_.size());
  std::iota(piece.begin(), piece.end(), 0u);
  const auto root = [&](std::uint32_t cell) {
    while (piece[cell] != cell) cell = piece[cell] = piece[piece[cell]];
    return cell;
  };
  for (const HalfEdge& e : half_edges_) {
    if (e.twin == kNone) continue;
    const std::uint32_t other = half_edges_[e.twin].cell;
    if (is_marked_[e.cell] != 0 || is_marked_[other] != 0) continue;
    const std::uint32_t a = root(e.cell);
    const std::uint32_t b = root(other);
    piece[std::max(a, b)] = std::min(a, b);
  }
  for (std::uint32_t cell = 0; cell < piece.size(); ++cell) piece[cell] = root(cell);
  return piece;
}

}  // namespace particle_surface_tracker::remeshing
