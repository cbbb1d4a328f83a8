#include "half_edges.h"

#include <algorithm>

#include <fmt/format.h>

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

/// \return what is wrong with the mesh, or nothing; `twins` are of no use if there is something.
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

void require_none(const std::string& trouble) {
  if (!trouble.empty()) throw MeshError(trouble + "; mesh upkeep needs a closed, oriented 2-manifold");
}

}  // namespace

void pair_half_edges(std::size_t vertex_count, const std::vector<Triangle>& triangles,
                     std::vector<std::uint32_t>& twins) {
  require_none(try_to_pair_half_edges(vertex_count, triangles, twins));
}

std::string try_to_update_twins(const TriangleMesh& mesh, MeshTwins& twins) {
  if (twins.connectivity == mesh.connectivity()) return {};
  twins.connectivity = 0;
  std::string trouble = try_to_pair_half_edges(mesh.vertex_count(), mesh.triangles(), twins.of_half_edges);
  if (trouble.empty()) twins.connectivity = mesh.connectivity();
  return trouble;
}

void update_twins(const TriangleMesh& mesh, MeshTwins& twins) {
  require_none(try_to_update_twins(mesh, twins));
}

}  // namespace particle_surface_tracker
