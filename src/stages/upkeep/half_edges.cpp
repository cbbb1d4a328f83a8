#include "half_edges.h"

#include <algorithm>
#include <atomic>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {

namespace {

/// The half-edges in the order of the vertex that they start from: those of vertex v are at begin[v] up to
/// begin[v + 1].
struct OutgoingHalfEdges {
  struct Entry {
    std::uint32_t end;
    std::uint32_t half_edge;
  };
  std::vector<std::uint32_t> begin;
  std::vector<Entry> entries;

  OutgoingHalfEdges(std::size_t vertex_count, const std::vector<Triangle>& triangles)
      : begin(vertex_count + 2, 0), entries(3 * triangles.size()) {
    for (const Triangle& triangle : triangles) {
      for (const std::uint32_t vertex : triangle) ++begin[vertex + 2];
    }
    for (std::size_t v = 2; v < begin.size(); ++v) begin[v] += begin[v - 1];
    std::uint32_t h = 0;
    for (const Triangle& t : triangles) {
      entries[begin[t[0] + 1]++] = {t[1], h++};
      entries[begin[t[1] + 1]++] = {t[2], h++};
      entries[begin[t[2] + 1]++] = {t[0], h++};
    }
    begin.pop_back();
  }

  /// The only half-edge from `from` to `to`, or kNoHalfEdge if there is none or more than one.
  std::uint32_t find(std::uint32_t from, std::uint32_t to) const {
    std::uint32_t found = kNoHalfEdge;
    for (std::uint32_t n = begin[from]; n < begin[from + 1]; ++n) {
      if (entries[n].end != to) continue;
      if (found != kNoHalfEdge) return kNoHalfEdge;
      found = entries[n].half_edge;
    }
    return found;
  }
};

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

std::string try_to_pair_half_edges(std::size_t vertex_count, const std::vector<Triangle>& triangles,
                                   std::vector<std::uint32_t>& twins) {
  const OutgoingHalfEdges outgoing(vertex_count, triangles);
  twins.assign(outgoing.entries.size(), kNoHalfEdge);
  // Every edge is looked up once, from its lower vertex.
  for (std::uint32_t a = 0; a < vertex_count; ++a) {
    for (std::uint32_t n = outgoing.begin[a]; n < outgoing.begin[a + 1]; ++n) {
      const auto [b, h] = outgoing.entries[n];
      if (b <= a || outgoing.find(a, b) != h) continue;
      const std::uint32_t twin = outgoing.find(b, a);
      if (twin == kNoHalfEdge) continue;
      twins[h] = twin;
      twins[twin] = h;
    }
  }
  const auto unpaired = std::find(twins.begin(), twins.end(), kNoHalfEdge);
  if (unpaired != twins.end()) {
    const auto h = static_cast<std::uint32_t>(unpaired - twins.begin());
    return fmt::format("the edge between vertices {} and {} does not have one triangle on either side",
                       start_of(triangles, h), end_of(triangles, h));
  }
  for (std::size_t v = 0; v < vertex_count; ++v) {
    const std::uint32_t count = outgoing.begin[v + 1] - outgoing.begin[v];
    if (count > 0 && umbrella_size(twins, outgoing.entries[outgoing.begin[v]].half_edge) != count) {
      return fmt::format("vertex {} has more than one umbrella of triangles", v);
    }
  }
  return {};
}

void pair_half_edges(std::size_t vertex_count, const std::vector<Triangle>& triangles,
                     std::vector<std::uint32_t>& twins) {
  const std::string trouble = try_to_pair_half_edges(vertex_count, triangles, twins);
  if (!trouble.empty()) throw MeshError(trouble + "; mesh upkeep needs a closed, oriented 2-manifold");
}

bool twins_fit(const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& twins,
               std::uint32_t triangle) {
  for (std::uint32_t h = 3 * triangle; h < 3 * triangle + 3; ++h) {
    const std::uint32_t twin = twins[h];
    if (twin >= twins.size()) return false;
    if (start_of(triangles, h) != end_of(triangles, twin) || end_of(triangles, h) != start_of(triangles, twin)) {
      return false;
    }
  }
  return true;
}

bool twins_fit(const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& twins) {
  if (twins.size() != 3 * triangles.size()) return false;
  std::atomic<bool> fit = true;
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(triangles.size()), 2048),
                    [&](const auto& range) {
                      for (std::uint32_t t = range.begin(); t != range.end() && fit; ++t) {
                        if (!twins_fit(triangles, twins, t)) fit = false;
                      }
                    });
  return fit;
}

void update_twins(std::size_t vertex_count, const std::vector<Triangle>& triangles, std::vector<std::uint32_t>& twins) {
  if (!twins_fit(triangles, twins)) pair_half_edges(vertex_count, triangles, twins);
}

}  // namespace particle_surface_tracker
