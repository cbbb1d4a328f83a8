#include "editable_surface.h"

#include <algorithm>
#include <utility>

namespace particle_surface_tracker {

namespace {

/// Where the foot of a position on an edge lies: 0 at `from` or before it, 1 at `to` or beyond.
double share_along_edge(const Vec3d& from, const Vec3d& to, const Vec3d& position) {
  const Vec3d edge = to - from;
  const double squared_length = edge.squaredNorm();
  return squared_length > 0.0 ? std::clamp((position - from).dot(edge) / squared_length, 0.0, 1.0) : 0.5;
}

}  // namespace

EditableSurface::EditableSurface(TriangleMesh& mesh, std::vector<std::uint32_t>& twins)
    : mesh_(mesh),
      triangles_(mesh.triangles()),
      twins_(twins),
      outgoing_(mesh.vertex_count(), kNoHalfEdge),
      is_fresh_(mesh.vertex_count(), false) {
  for (std::uint32_t h = 0; h < twins_.size(); ++h) outgoing_[start(h)] = h;
}

std::uint32_t EditableSurface::valence(std::uint32_t vertex) const {
  std::uint32_t count = 0;
  for_each_outgoing(vertex, [&count](std::uint32_t) { ++count; });
  return count;
}

void EditableSurface::pair(std::uint32_t a, std::uint32_t b) {
  twins_[a] = b;
  twins_[b] = a;
}

std::uint32_t EditableSurface::split(std::uint32_t half_edge, const Vec3f& position) {
  const std::uint32_t other = twin(half_edge);
  const std::uint32_t from = start(half_edge), to = end(half_edge);
  const double share = share_along_edge(this->position(from), this->position(to), position.cast<double>());
  const std::uint32_t middle = mesh_.append_vertex(position, {{from, 1.0 - share}, {to, share}});
  is_fresh_.push_back(true);
  const std::uint32_t second_half = split_triangle(half_edge, middle);
  const std::uint32_t second_half_of_other = split_triangle(other, middle);
  pair(half_edge, second_half_of_other);
  pair(second_half, other);
  outgoing_.push_back(second_half);
  return middle;
}

/// Splits triangle (a, b, c), where the half-edge runs from a to b: it becomes (a, m, c), and (m, b, c) is new.
/// \return the half-edge from m to b.
std::uint32_t EditableSurface::split_triangle(std::uint32_t half_edge, std::uint32_t middle) {
  const std::uint32_t to_apex = next_half_edge(half_edge);
  const std::uint32_t b = start(to_apex), apex = end(to_apex);
  const auto second_half = static_cast<std::uint32_t>(twins_.size());
  const std::uint32_t moved = twin(to_apex);
  triangles_.push_back({middle, b, apex});
  twins_.resize(twins_.size() + 3);
  triangles_[to_apex / 3][to_apex % 3] = middle;
  pair(second_half + 1, moved);
  pair(second_half + 2, to_apex);
  outgoing_[b] = second_half + 1;
  return second_half;
}

void EditableSurface::collapse(std::uint32_t half_edge, const Vec3f& position) {
  const std::uint32_t dropped = start(half_edge), kept = end(half_edge);
  for_each_outgoing(dropped, [&](std::uint32_t h) { triangles_[h / 3][h % 3] = kept; });
  const std::uint32_t other = twin(half_edge);
  remove_triangle(half_edge);
  remove_triangle(other);
  outgoing_[dropped] = kNoHalfEdge;
  if (position == mesh_.positions()[kept]) return;
  const double share = share_along_edge(this->position(dropped), this->position(kept), position.cast<double>());
  mesh_.attributes().set_blend(kept, {{dropped, 1.0 - share}, {kept, share}});
  mesh_.positions()[kept] = position;
  is_fresh_[kept] = true;
}

/// Takes out a triangle whose edge at the half-edge has shrunk to a point, and joins what lies beyond its other two.
void EditableSurface::remove_triangle(std::uint32_t half_edge) {
  const std::uint32_t beyond_next = twin(next_half_edge(half_edge));
  const std::uint32_t beyond_previous = twin(previous_half_edge(half_edge));
  pair(beyond_next, beyond_previous);
  outgoing_[start(beyond_next)] = beyond_next;
  outgoing_[start(beyond_previous)] = beyond_previous;
  triangles_[half_edge / 3] = {kGone, kGone, kGone};
}

void EditableSurface::flip(std::uint32_t half_edge) {
  // (a, b, c) and (b, a, d) become (d, b, c) and (c, a, d).
  const std::uint32_t other = twin(half_edge);
  const std::uint32_t a = start(half_edge), b = end(half_edge), c = apex(half_edge), d = apex(other);
  const std::uint32_t beyond_ca = twin(previous_half_edge(half_edge)), beyond_db = twin(previous_half_edge(other));
  triangles_[half_edge / 3][half_edge % 3] = d;
  triangles_[other / 3][other % 3] = c;
  pair(half_edge, beyond_db);
  pair(other, beyond_ca);
  pair(previous_half_edge(half_edge), previous_half_edge(other));
  outgoing_[a] = next_half_edge(other);
  outgoing_[b] = next_half_edge(half_edge);
  outgoing_[c] = other;
  outgoing_[d] = half_edge;
}

std::vector<std::uint32_t> EditableSurface::finish() {
  std::vector<std::uint32_t> fresh;
  std::uint32_t index = 0;
  for (std::uint32_t v = 0; v < outgoing_.size(); ++v) {
    if (outgoing_[v] == kNoHalfEdge) continue;
    if (is_fresh_[v]) fresh.push_back(index);
    ++index;
  }
  close_gaps();
  mesh_.set_triangles(std::move(triangles_));
  mesh_.remove_unused_vertices();
  return fresh;
}

/// Moves triangles to where those before them have gone, and their twins with them.
void EditableSurface::close_gaps() {
  std::vector<std::uint32_t> new_index(triangles_.size());
  std::uint32_t count = 0;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    new_index[t] = count;
    if (is_alive(t)) ++count;
  }
  if (count == triangles_.size()) return;
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
    if (!is_alive(t)) continue;
    const std::uint32_t to = new_index[t];
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t twin = twins_[3 * t + k];
      twins_[3 * to + k] = 3 * new_index[twin / 3] + twin % 3;
    }
    triangles_[to] = triangles_[t];
  }
  triangles_.resize(count);
  twins_.resize(3 * static_cast<std::size_t>(count));
}

}  // namespace particle_surface_tracker
