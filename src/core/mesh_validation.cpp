#include "particle_surface_tracker/core/mesh_validation.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;

/// How often a defect occurs, and its first place: the pair of vertices that is lowest in order.
struct Defect {
  std::size_t count = 0;
  std::pair<std::uint32_t, std::uint32_t> first = {kNone, kNone};

  void add(std::uint32_t a, std::uint32_t b) { add(Defect{1, {a, b}}); }
  void add(const Defect& other) {
    count += other.count;
    first = std::min(first, other.first);
  }
};

struct Defects {
  Defect duplicate_triangles, crowded_edges, flipped_edges, open_edges, split_vertices;

  void add(const Defects& other) {
    duplicate_triangles.add(other.duplicate_triangles);
    crowded_edges.add(other.crowded_edges);
    flipped_edges.add(other.flipped_edges);
    open_edges.add(other.open_edges);
    split_vertices.add(other.split_vertices);
  }
};

/// The edge opposite a vertex in one of its triangles: the vertex sees it run from `from` to `to`.
struct LinkEdge {
  std::uint32_t from, to;
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
  for (const Triangle& t : triangles) {
    for (int k = 0; k < 3; ++k) links.edges[next[t[k]]++] = {t[(k + 1) % 3], t[(k + 2) % 3]};
  }
  return links;
}

/// A neighbour of a vertex, once for every link edge that it starts or ends.
struct LinkEnd {
  std::uint32_t neighbour;
  bool starts;
};

/// Looks at the edges between `vertex` and its neighbours; each edge is counted at its lower end only.
/// \return whether all of them are shared by two triangles of opposite directions.
bool check_edges(std::uint32_t vertex, std::vector<LinkEnd>& ends, Defects& defects) {
  std::sort(ends.begin(), ends.end(), [](const LinkEnd& a, const LinkEnd& b) { return a.neighbour < b.neighbour; });
  bool good = true;
  for (std::size_t begin = 0, end = 0; begin < ends.size(); begin = end) {
    const std::uint32_t neighbour = ends[begin].neighbour;
    std::size_t starting = 0;
    for (; end < ends.size() && ends[end].neighbour == neighbour; ++end) starting += ends[end].starts;
    const std::size_t sharing = end - begin;
    if (sharing == 2 && starting == 1) continue;
    good = false;
    if (neighbour < vertex) continue;
    Defect& defect = sharing == 1 ? defects.open_edges : sharing == 2 ? defects.flipped_edges : defects.crowded_edges;
    defect.add(vertex, neighbour);
  }
  return good;
}

/// Counts triangles of the same three vertices, in whatever order, at the lowest of the three.
void check_duplicates(std::uint32_t vertex, std::vector<std::pair<std::uint32_t, std::uint32_t>>& opposite,
                      Defects& defects) {
  std::sort(opposite.begin(), opposite.end());
  for (std::size_t i = 1; i < opposite.size(); ++i) {
    if (opposite[i] == opposite[i - 1]) defects.duplicate_triangles.add(vertex, opposite[i].first);
  }
}

/// Whether the link edges, which form closed loops, form a single one.
bool is_one_loop(std::vector<LinkEdge>& link) {
  const auto starts_before = [](const LinkEdge& a, const LinkEdge& b) { return a.from < b.from; };
  std::sort(link.begin(), link.end(), starts_before);
  std::size_t length = 0;
  std::uint32_t at = link.front().from;
  do {
    at = std::lower_bound(link.begin(), link.end(), LinkEdge{at, at}, starts_before)->to;
    ++length;
  } while (at != link.front().from);
  return length == link.size();
}

Defects check_vertices(const Links& links, std::uint32_t first, std::uint32_t last) {
  Defects defects;
  std::vector<LinkEdge> link;
  std::vector<LinkEnd> ends;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> opposite;
  for (std::uint32_t vertex = first; vertex < last; ++vertex) {
    link.assign(links.edges.data() + links.offsets[vertex], links.edges.data() + links.offsets[vertex + 1]);
    if (link.empty()) continue;
    ends.clear();
    opposite.clear();
    for (const LinkEdge& edge : link) {
      ends.push_back({edge.from, true});
      ends.push_back({edge.to, false});
      const auto [low, high] = std::minmax(edge.from, edge.to);
      if (vertex < low) opposite.emplace_back(low, high);
    }
    check_duplicates(vertex, opposite, defects);
    if (check_edges(vertex, ends, defects) && !is_one_loop(link)) defects.split_vertices.add(vertex, vertex);
  }
  return defects;
}

Defects check_connectivity(std::size_t vertex_count, const std::vector<Triangle>& triangles) {
  const Links links = collect_links(vertex_count, triangles);
  constexpr std::uint32_t kVerticesPerTask = 2048;
  using Range = tbb::blocked_range<std::uint32_t>;
  return tbb::parallel_reduce(
      Range(0, static_cast<std::uint32_t>(vertex_count), kVerticesPerTask), Defects(),
      [&](const Range& range, Defects defects) {
        defects.add(check_vertices(links, range.begin(), range.end()));
        return defects;
      },
      [](Defects a, const Defects& b) {
        a.add(b);
        return a;
      });
}

std::string describe_vertex(const std::vector<Vec3f>& positions, std::uint32_t vertex) {
  const Vec3f& p = positions[vertex];
  return fmt::format("vertex {} at ({:g}, {:g}, {:g})", vertex, p.x(), p.y(), p.z());
}

/// What is wrong before anything can be said about neighbours; empty if nothing.
std::string describe_bad_elements(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
  if (triangles.empty()) return "it has no triangles";
  std::size_t degenerate = 0, first_degenerate = 0;
  std::vector<char> used(positions.size(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = triangles[t];
    const std::uint32_t highest = std::max({a, b, c});
    if (highest >= positions.size()) {
      return fmt::format("triangle {} names vertex {}, but there are only {}", t, highest, positions.size());
    }
    used[a] = used[b] = used[c] = 1;
    if (a != b && b != c && c != a) continue;
    if (degenerate++ == 0) first_degenerate = t;
  }

  std::string text;
  const auto append = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  const auto is_bad = [](const Vec3f& p) { return !p.allFinite(); };
  if (const auto bad = std::count_if(positions.begin(), positions.end(), is_bad); bad > 0) {
    const auto first = std::find_if(positions.begin(), positions.end(), is_bad) - positions.begin();
    append(fmt::format("{} vertices are not finite, first {}", bad,
                       describe_vertex(positions, static_cast<std::uint32_t>(first))));
  }
  if (degenerate > 0) {
    append(fmt::format("{} triangles are degenerate (a vertex occurs twice), first triangle {} with {}", degenerate,
                       first_degenerate, describe_vertex(positions, triangles[first_degenerate][0])));
  }
  if (const auto unused = std::count(used.begin(), used.end(), 0); unused > 0) {
    const auto first = std::find(used.begin(), used.end(), 0) - used.begin();
    append(fmt::format("{} vertices belong to no triangle, first {}", unused,
                       describe_vertex(positions, static_cast<std::uint32_t>(first))));
  }
  return text;
}

std::string describe_connectivity(const std::vector<Vec3f>& positions, const Defects& defects) {
  std::string text;
  const auto append = [&](const Defect& defect, const char* what, const char* first) {
    if (defect.count == 0) return;
    text += fmt::format("{}{} {}, first {} {}", text.empty() ? "" : "; ", defect.count, what, first,
                        describe_vertex(positions, defect.first.first));
    if (defect.first.second != defect.first.first) {
      text += fmt::format(" and {}", describe_vertex(positions, defect.first.second));
    }
  };
  append(defects.open_edges, "edges are open (only one triangle; fill the holes)", "between");
  append(defects.crowded_edges, "edges are non-manifold (more than two triangles; separate the sheets)", "between");
  append(defects.flipped_edges,
         "edges lie between triangles of opposite orientation (the mesh is partly flipped; orient it consistently)",
         "between");
  append(defects.split_vertices, "vertices are non-manifold (several umbrellas meet in a point; double the vertex)",
         "is");
  append(defects.duplicate_triangles, "triangles are there twice (remove the duplicates)", "with");
  return text;
}

}  // namespace

std::string describe_mesh_defects(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
  std::string text = describe_bad_elements(positions, triangles);
  if (!text.empty()) return text;
  return describe_connectivity(positions, check_connectivity(positions.size(), triangles));
}

void check_closed_manifold(const TriangleMesh& mesh) {
  const std::string defects = describe_mesh_defects(mesh.positions(), mesh.triangles());
  if (!defects.empty()) throw MeshError("The mesh is not a closed oriented manifold: " + defects + ".");
}

}  // namespace particle_surface_tracker
