#include "sequences/mesh_judge.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <Eigen/Geometry>

#include "sequences/disjoint_sets.h"

namespace particle_surface_tracker::test {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

/// An edge as a triangle runs along it: its lower and upper vertex, and whether it runs upwards.
struct DirectedEdge {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  bool upwards = false;
};

void count_edge_defects(const std::vector<Triangle>& triangles, SurfaceDefects& defects) {
  std::vector<DirectedEdge> edges;
  for (const Triangle& t : triangles) {
    for (int side = 0; side < 3; ++side) {
      const std::uint32_t from = t[side];
      const std::uint32_t to = t[(side + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), from < to});
    }
  }
  const auto key = [](const DirectedEdge& e) { return std::pair(e.low, e.high); };
  std::sort(edges.begin(), edges.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && key(edges[end]) == key(edges[begin])) ++end;
    if (end - begin == 1) ++defects.open_edges;
    if (end - begin > 2) ++defects.non_manifold_edges;
    if (end - begin == 2 && edges[begin].upwards == edges[begin + 1].upwards) ++defects.flipped_edges;
  }
}

/// Triangles around a vertex belong to one umbrella when they hang together by edges at that vertex. Every corner of a
/// triangle is a number of its own here; corners at one vertex are merged across the edges that two triangles share
/// there.
void count_vertex_defects(std::size_t vertex_count, const std::vector<Triangle>& triangles, SurfaceDefects& defects) {
  struct Spoke {
    std::uint32_t hub, rim, corner;
  };
  std::vector<Spoke> spokes;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    for (std::uint32_t side = 0; side < 3; ++side) {
      for (const std::uint32_t other : {(side + 1) % 3, (side + 2) % 3}) {
        spokes.push_back({triangles[t][side], triangles[t][other], 3 * t + side});
      }
    }
  }
  const auto key = [](const Spoke& s) { return std::array{s.hub, s.rim, s.corner}; };
  std::sort(spokes.begin(), spokes.end(), [&](const Spoke& a, const Spoke& b) { return key(a) < key(b); });
  DisjointSets umbrellas(3 * triangles.size());
  for (std::size_t n = 1; n < spokes.size(); ++n) {
    const bool shared = spokes[n].hub == spokes[n - 1].hub && spokes[n].rim == spokes[n - 1].rim;
    if (shared) umbrellas.merge(spokes[n].corner, spokes[n - 1].corner);
  }
  std::vector<std::set<std::uint32_t>> of_vertex(vertex_count);
  for (const Spoke& s : spokes) of_vertex[s.hub].insert(umbrellas.find(s.corner));
  for (const auto& umbrellas_here : of_vertex) {
    if (umbrellas_here.empty()) ++defects.unused_vertices;
    if (umbrellas_here.size() > 1) ++defects.non_manifold_vertices;
  }
}

/// Twice the area, along the normal.
Vec3d area_normal(const std::vector<Vec3f>& positions, const Triangle& t) {
  const Vec3d a = positions[t[0]].cast<double>();
  return (positions[t[1]].cast<double>() - a).cross(positions[t[2]].cast<double>() - a);
}

}  // namespace

SurfaceDefects find_surface_defects(std::size_t vertex_count, const std::vector<Triangle>& triangles) {
  SurfaceDefects defects;
  defects.degenerate_triangles =
      static_cast<std::size_t>(std::count_if(triangles.begin(), triangles.end(), [](const Triangle& t) {
        return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
      }));
  count_edge_defects(triangles, defects);
  count_vertex_defects(vertex_count, triangles, defects);
  return defects;
}

std::size_t count_self_intersecting_triangles(const std::vector<Vec3f>& positions,
                                              const std::vector<Triangle>& triangles) {
  Surface surface;
  std::vector<Surface::Vertex_index> vertices;
  for (const Vec3f& p : positions) vertices.push_back(surface.add_vertex(Kernel::Point_3(p.x(), p.y(), p.z())));
  for (const auto& [a, b, c] : triangles) {
    if (surface.add_face(vertices[a], vertices[b], vertices[c]) == Surface::null_face()) {
      throw std::invalid_argument("count_self_intersecting_triangles: the triangles are not a manifold");
    }
  }
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(pairs));
  std::set<Surface::Face_index> faces;
  for (const auto& [first, second] : pairs) faces.insert({first, second});
  return faces.size();
}

std::size_t count_inverted_triangles(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
  std::vector<Vec3d> ring_normals(positions.size(), Vec3d::Zero());
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) ring_normals[v] += area_normal(positions, t);
  }
  return static_cast<std::size_t>(std::count_if(triangles.begin(), triangles.end(), [&](const Triangle& t) {
    const Vec3d around = ring_normals[t[0]] + ring_normals[t[1]] + ring_normals[t[2]];
    return area_normal(positions, t).dot(around) < 0.0;
  }));
}

double enclosed_volume(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
  if (positions.empty()) return 0.0;
  // From a point of the mesh, so that a body far from the origin loses no digits.
  const Vec3d origin = positions[0].cast<double>();
  double sixfold = 0.0;
  for (const Triangle& t : triangles) {
    sixfold += (positions[t[0]].cast<double>() - origin).dot(area_normal(positions, t));
  }
  return sixfold / 6.0;
}

std::vector<Triangle> welded_by_position(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
  std::map<std::array<float, 3>, std::uint32_t> first;
  std::vector<Triangle> welded = triangles;
  for (Triangle& t : welded) {
    for (std::uint32_t& v : t) {
      const Vec3f& p = positions[v];
      v = first.try_emplace({p.x(), p.y(), p.z()}, v).first->second;
    }
  }
  return welded;
}

std::size_t count_clusters(std::size_t vertex_count, const std::vector<Triangle>& triangles,
                           const std::vector<std::uint32_t>& members) {
  std::vector<bool> is_member(vertex_count, false);
  for (const std::uint32_t v : members) is_member[v] = true;
  DisjointSets clusters(vertex_count);
  for (const Triangle& t : triangles) {
    for (int side = 0; side < 3; ++side) {
      const std::uint32_t a = t[side];
      const std::uint32_t b = t[(side + 1) % 3];
      if (is_member[a] && is_member[b]) clusters.merge(a, b);
    }
  }
  return static_cast<std::size_t>(
      std::count_if(members.begin(), members.end(), [&](std::uint32_t v) { return clusters.find(v) == v; }));
}

}  // namespace particle_surface_tracker::test
