#include "half_edges.h"

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {

namespace {

/// The half-edges in the order of the vertex that they start from: those of vertex v are order[begin[v]] up to
/// order[begin[v + 1]].
struct OutgoingHalfEdges {
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> order;

  OutgoingHalfEdges(std::size_t vertex_count, const std::vector<Triangle>& triangles)
      : begin(vertex_count + 2, 0), order(3 * triangles.size()) {
    for (const Triangle& triangle : triangles) {
      for (const std::uint32_t vertex : triangle) ++begin[vertex + 2];
    }
    for (std::size_t v = 2; v < begin.size(); ++v) begin[v] += begin[v - 1];
    for (std::uint32_t h = 0; h < order.size(); ++h) order[begin[start_of(triangles, h) + 1]++] = h;
    begin.pop_back();
  }
};

/// The only half-edge from `from` to `to`, or kNoHalfEdge if there is none or more than one.
std::uint32_t find_half_edge(const OutgoingHalfEdges& outgoing, const std::vector<Triangle>& triangles,
                             std::uint32_t from, std::uint32_t to) {
  std::uint32_t found = kNoHalfEdge;
  for (std::uint32_t n = outgoing.begin[from]; n < outgoing.begin[from + 1]; ++n) {
    if (end_of(triangles, outgoing.order[n]) != to) continue;
    if (found != kNoHalfEdge) return kNoHalfEdge;
    found = outgoing.order[n];
  }
  return found;
}

/// Number of half-edges that one turn around the start of a half-edge meets.
std::uint32_t umbrella_size(const std::vector<std::uint32_t>& twins, std::uint32_t half_edge) {
  std::uint32_t size = 0;
  std::uint32_t h = half_edge;
  do {
    h = twins[previous_half_edge(h)];
    ++size;
  } while (h != half_edge);
  return size;
}

}  // namespace

void pair_half_edges(std::size_t vertex_count, const std::vector<Triangle>& triangles,
                     std::vector<std::uint32_t>& twins) {
  const OutgoingHalfEdges outgoing(vertex_count, triangles);
  twins.resize(outgoing.order.size());
  for (std::uint32_t h = 0; h < twins.size(); ++h) {
    const std::uint32_t a = start_of(triangles, h), b = end_of(triangles, h);
    twins[h] = find_half_edge(outgoing, triangles, b, a);
    if (twins[h] == kNoHalfEdge || find_half_edge(outgoing, triangles, a, b) != h) {
      throw MeshError(fmt::format(
          "the edge between vertices {} and {} does not have one triangle on either side; mesh upkeep needs "
          "a closed, oriented 2-manifold",
          a, b));
    }
  }
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const std::uint32_t count = outgoing.begin[v + 1] - outgoing.begin[v];
    if (count > 0 && umbrella_size(twins, outgoing.order[outgoing.begin[v]]) != count) {
      throw MeshError(
          fmt::format("vertex {} has more than one umbrella of triangles; mesh upkeep needs a 2-manifold", v));
    }
  }
}

bool twins_fit(const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& twins,
               std::uint32_t triangle) {
  for (std::uint32_t h = 3 * triangle; h < 3 * triangle + 3; ++h) {
    const std::uint32_t twin = twins[h];
    if (start_of(triangles, h) != end_of(triangles, twin) || end_of(triangles, h) != start_of(triangles, twin)) {
      return false;
    }
  }
  return true;
}

}  // namespace particle_surface_tracker
