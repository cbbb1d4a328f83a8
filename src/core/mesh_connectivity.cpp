#include "mesh_connectivity.h"

#include <algorithm>
#include <array>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

namespace particle_surface_tracker {
namespace {

/// The edge opposite a vertex in one of its triangles: the vertex sees it run from `from` to `to`.
struct LinkEdge {
  std::uint32_t from, to, triangle;
};

/// The link edges of all vertices, those of vertex v at [offsets[v], offsets[v + 1]). Two triangles share an edge (v,
/// w) as they should exactly when w starts one link edge of v and ends one.
struct Links {
  std::vector<std::size_t> offsets;
  std::vector<LinkEdge> edges;
};

Links collect_links(std::size_t vertex_count, const std::vector<Triangle>& triangles) {
  Links links;
  links.offsets.assign(vertex_count + 1, 0);
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t vertex : triangle) ++links.offsets[vertex + 1];
  }
  for (std::size_t v = 0; v < vertex_count; ++v) links.offsets[v + 1] += links.offsets[v];
  links.edges.resize(3 * triangles.size());
  std::vector<std::size_t> next(links.offsets.begin(), links.offsets.end() - 1);
  for (std::uint32_t n = 0; n < triangles.size(); ++n) {
    const Triangle& t = triangles[n];
    for (int k = 0; k < 3; ++k) links.edges[next[t[k]]++] = {t[(k + 1) % 3], t[(k + 2) % 3], n};
  }
  return links;
}

/// Whether some link edges form one loop: nothing then is wrong with a vertex of at least three triangles. Every edge
/// has one successor here, the first that starts where it ends; so if the way from one edge leads back to it after as
/// many steps as there are edges, it has met all of them, and no neighbour starts, or ends, two.
bool is_plainly_one_loop(const LinkEdge* edges, std::size_t count) {
  std::size_t at = 0;
  for (std::size_t length = 1; length <= count; ++length) {
    std::size_t next = 0;
    while (next < count && edges[next].from != edges[at].to) ++next;
    if (next == count) return false;
    if (next == 0) return length == count;
    at = next;
  }
  return false;
}

/// A neighbour of a vertex, once for every link edge that it starts or ends.
struct LinkEnd {
  std::uint32_t neighbour;
  bool starts;
};

/// Adds what was found among later vertices.
void append(MeshDefects& defects, const MeshDefects& behind) {
  for (MeshDefect MeshDefects::*kind :
       {&MeshDefects::duplicate_triangles, &MeshDefects::open_edges, &MeshDefects::non_manifold_edges,
        &MeshDefects::flipped_edges, &MeshDefects::non_manifold_vertices}) {
    (defects.*kind).append(behind.*kind);
  }
}

/// Looks at the vertices one after the other; scratch space stays from one to the next.
class VertexExaminer {
 public:
  VertexExaminer(const std::vector<Vec3f>& positions, const Links& links, MeshDefects& found)
      : positions_(positions), links_(links), found_(found) {}

  MeshConnectivity::VertexState examine(std::uint32_t vertex) {
    const LinkEdge* const link = links_.edges.data() + links_.offsets[vertex];
    const std::size_t size = links_.offsets[vertex + 1] - links_.offsets[vertex];
    if (size == 0) return MeshConnectivity::kGood;
    // Around nearly all vertices, and at a small part of the price of what tells everything that is wrong.
    if (size >= kLeastPlain && size <= kMostPlain && is_plainly_one_loop(link, size)) return MeshConnectivity::kGood;
    link_.assign(link, link + size);
    examine_duplicates(vertex);
    if (!examine_edges(vertex)) return MeshConnectivity::kBadEdge;
    if (is_one_loop()) return MeshConnectivity::kGood;
    found_.non_manifold_vertices.add({vertex, vertex, positions_[vertex], positions_[vertex]});
    return MeshConnectivity::kSeveralUmbrellas;
  }

 private:
  /// Two triangles around a vertex can be the same; more than these are searched through faster in order.
  static constexpr std::size_t kLeastPlain = 3;
  static constexpr std::size_t kMostPlain = 32;

  /// Counts triangles of the same three vertices, in whatever order, at the lowest of the three.
  void examine_duplicates(std::uint32_t vertex) {
    opposite_.clear();
    for (const LinkEdge& edge : link_) {
      const auto [low, high] = std::minmax(edge.from, edge.to);
      if (vertex < low) opposite_.push_back({low, high, edge.triangle});
    }
    std::sort(opposite_.begin(), opposite_.end());
    for (std::size_t i = 1, first = 0; i < opposite_.size(); ++i) {
      const bool is_same = opposite_[i][0] == opposite_[first][0] && opposite_[i][1] == opposite_[first][1];
      if (is_same) {
        found_.duplicate_triangles.add({opposite_[i][2], opposite_[first][2], positions_[vertex], positions_[vertex]});
      } else {
        first = i;
      }
    }
  }

  /// Looks at the edges between `vertex` and its neighbours; each edge is counted at its lower end only.
  /// \return whether all of them are shared by two triangles of opposite directions.
  bool examine_edges(std::uint32_t vertex) {
    ends_.clear();
    for (const LinkEdge& edge : link_) {
      ends_.push_back({edge.from, true});
      ends_.push_back({edge.to, false});
    }
    std::sort(ends_.begin(), ends_.end(), [](const LinkEnd& a, const LinkEnd& b) { return a.neighbour < b.neighbour; });
    bool good = true;
    for (std::size_t begin = 0, end = 0; begin < ends_.size(); begin = end) {
      const std::uint32_t neighbour = ends_[begin].neighbour;
      std::size_t starting = 0;
      for (; end < ends_.size() && ends_[end].neighbour == neighbour; ++end) starting += ends_[end].starts;
      const std::size_t sharing = end - begin;
      if (sharing == 2 && starting == 1) continue;
      good = false;
      if (neighbour < vertex) continue;
      MeshDefect& defect = sharing == 1   ? found_.open_edges
                           : sharing == 2 ? found_.flipped_edges
                                          : found_.non_manifold_edges;
      defect.add({vertex, neighbour, positions_[vertex], positions_[neighbour]});
    }
    return good;
  }

  /// Whether the link edges, which form closed loops, form a single one.
  bool is_one_loop() {
    const auto starts_before = [](const LinkEdge& a, const LinkEdge& b) { return a.from < b.from; };
    std::sort(link_.begin(), link_.end(), starts_before);
    std::size_t length = 0;
    std::uint32_t at = link_.front().from;
    do {
      at = std::lower_bound(link_.begin(), link_.end(), LinkEdge{at, at, 0}, starts_before)->to;
      ++length;
    } while (at != link_.front().from);
    return length == link_.size();
  }

  const std::vector<Vec3f>& positions_;
  const Links& links_;
  MeshDefects& found_;
  std::vector<LinkEdge> link_;
  std::vector<LinkEnd> ends_;
  std::vector<std::array<std::uint32_t, 3>> opposite_;
};

}  // namespace

MeshConnectivity examine_connectivity(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
  const Links links = collect_links(positions.size(), triangles);
  MeshConnectivity connectivity;
  connectivity.vertex_states.assign(positions.size(), MeshConnectivity::kGood);
  constexpr std::uint32_t kVerticesPerTask = 2048;
  using Range = tbb::blocked_range<std::uint32_t>;
  connectivity.defects = tbb::parallel_reduce(
      Range(0, static_cast<std::uint32_t>(positions.size()), kVerticesPerTask), MeshDefects(),
      [&](const Range& range, MeshDefects found) {
        VertexExaminer examiner(positions, links, found);
        for (std::uint32_t v = range.begin(); v < range.end(); ++v) connectivity.vertex_states[v] = examiner.examine(v);
        return found;
      },
      [](MeshDefects a, const MeshDefects& b) {
        append(a, b);
        return a;
      });
  return connectivity;
}

}  // namespace particle_surface_tracker
