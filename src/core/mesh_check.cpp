#include "particle_surface_tracker/core/mesh_check.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include "exact_triangles.h"
#include "mesh_components.h"
#include "mesh_connectivity.h"
#include "triangle_tree.h"

namespace particle_surface_tracker {
namespace {

/// Two triangles, the lower one first.
using Pair = std::pair<std::uint32_t, std::uint32_t>;

MeshPlace vertex_place(const std::vector<Vec3f>& positions, std::uint32_t vertex) {
  return {vertex, vertex, positions[vertex], positions[vertex]};
}

/// The place of a triangle; at its first corner that is there.
MeshPlace triangle_place(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles, std::uint32_t t) {
  const auto is_there = [&](std::uint32_t v) { return v < positions.size(); };
  const auto corner = std::find_if(triangles[t].begin(), triangles[t].end(), is_there);
  const Vec3f position = corner != triangles[t].end() ? positions[*corner] : Vec3f(0, 0, 0);
  return {t, t, position, position};
}

bool is_degenerate(const Triangle& t) {
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

/// The triangles of some numbers; all of them are passed through without a copy.
class Selection {
 public:
  Selection(const std::vector<Triangle>& all, std::vector<std::uint32_t> chosen)
      : all_(all), chosen_(std::move(chosen)) {
    if (chosen_.size() == all_.size()) return;
    for (const std::uint32_t t : chosen_) copies_.push_back(all_[t]);
  }

  const std::vector<Triangle>& triangles() const { return chosen_.size() == all_.size() ? all_ : copies_; }
  std::uint32_t number(std::uint32_t chosen) const { return chosen_[chosen]; }

 private:
  const std::vector<Triangle>& all_;
  std::vector<std::uint32_t> chosen_;
  std::vector<Triangle> copies_;
};

template <typename Wanted>
Selection select(const std::vector<Triangle>& triangles, Wanted&& wanted) {
  std::vector<std::uint32_t> chosen;
  chosen.reserve(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (wanted(triangles[t])) chosen.push_back(t);
  }
  return Selection(triangles, std::move(chosen));
}

/// Defects of single vertices and triangles.
MeshDefects find_bad_elements(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
  MeshDefects defects;
  std::vector<char> is_used(positions.size(), 0);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    bool is_dangling = false;
    for (const std::uint32_t v : triangles[t]) {
      is_dangling |= v >= positions.size();
      if (v < positions.size()) is_used[v] = 1;
    }
    if (is_dangling) defects.dangling_triangles.add(triangle_place(positions, triangles, t));
    if (is_degenerate(triangles[t])) defects.degenerate_triangles.add(triangle_place(positions, triangles, t));
  }
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    if (!positions[v].allFinite()) defects.not_finite_vertices.add(vertex_place(positions, v));
    if (is_used[v] == 0) defects.unused_vertices.add(vertex_place(positions, v));
  }
  return defects;
}

/// Numbers in defects of connectivity are those of a selection until here.
void take_connectivity(MeshDefects&& found, const Selection& selection, MeshDefects& defects) {
  for (MeshPlace& place : found.duplicate_triangles.places) {
    place.index = selection.number(place.index);
    place.other = selection.number(place.other);
  }
  defects.duplicate_triangles = std::move(found.duplicate_triangles);
  defects.open_edges = std::move(found.open_edges);
  defects.non_manifold_edges = std::move(found.non_manifold_edges);
  defects.flipped_edges = std::move(found.flipped_edges);
  defects.non_manifold_vertices = std::move(found.non_manifold_vertices);
}

struct SurfaceDefects {
  MeshDefects defects;
  std::vector<MeshConnectivity::VertexState> vertex_states;
};

SurfaceDefects find_surface_defects(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
  SurfaceDefects found;
  found.defects = find_bad_elements(positions, triangles);
  const Selection selection = select(triangles, [&](const Triangle& t) {
    return std::max({t[0], t[1], t[2]}) < positions.size() && !is_degenerate(t);
  });
  MeshConnectivity connectivity = examine_connectivity(positions, selection.triangles());
  take_connectivity(std::move(connectivity.defects), selection, found.defects);
  found.vertex_states = std::move(connectivity.vertex_states);
  return found;
}

std::vector<char> mark_flat(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
  std::vector<char> is_flat_triangle(triangles.size());
  constexpr std::size_t kTrianglesPerTask = 1024;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles.size(), kTrianglesPerTask), [&](const auto& range) {
    for (std::size_t t = range.begin(); t < range.end(); ++t) is_flat_triangle[t] = is_flat(positions, triangles[t]);
  });
  return is_flat_triangle;
}

/// All pairs of triangles that meet, in increasing order.
std::vector<Pair> find_meeting_pairs(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles,
                                     const TriangleTree& tree) {
  tbb::enumerable_thread_specific<std::vector<Pair>> of_threads;
  tree.for_each_pair([&](std::uint32_t a, std::uint32_t b) {
    if (meet_beyond_shared(positions, triangles[a], triangles[b])) of_threads.local().push_back(std::minmax(a, b));
  });
  std::vector<Pair> pairs;
  for (const std::vector<Pair>& some : of_threads) pairs.insert(pairs.end(), some.begin(), some.end());
  tbb::parallel_sort(pairs.begin(), pairs.end());
  return pairs;
}

/// Counts the triangles in pairs; the places are the first pairs.
MeshDefect count_in_pairs(const std::vector<Vec3f>& positions, const Selection& selection,
                          const std::vector<Pair>& pairs) {
  MeshDefect defect;
  std::vector<char> is_in_pair(selection.triangles().size(), 0);
  for (const auto& [a, b] : pairs) {
    is_in_pair[a] = is_in_pair[b] = 1;
    if (defect.places.size() == MeshDefect::max_places) continue;
    const std::uint32_t a_vertex = selection.triangles()[a][0];
    const std::uint32_t b_vertex = selection.triangles()[b][0];
    defect.places.push_back({selection.number(a), selection.number(b), positions[a_vertex], positions[b_vertex]});
  }
  defect.count = static_cast<std::size_t>(std::count(is_in_pair.begin(), is_in_pair.end(), 1));
  return defect;
}

void judge_nesting(const std::vector<Vec3f>& positions, MeshCheck& check) {
  for (std::uint32_t c = 0; c < check.components.size(); ++c) {
    const MeshComponent& component = check.components[c];
    if (!component.is_closed) continue;
    const Vec3f& position = positions[component.first_vertex];
    const MeshPlace place = {c, c, position, position};
    const int around = component.winding_around;
    if (component.volume == 0.0) check.components_without_volume.add(place);
    if (component.volume > 0.0 && around > 0) check.solids_in_solids.add(place);
    if (component.volume < 0.0 && around < 1) check.inside_out_components.add(place);
    if (component.volume < 0.0 && around > 1) check.cavities_in_overlaps.add(place);
  }
}

/// Whatever is measured, on sound triangles only.
void check_geometry(const std::vector<Vec3f>& positions, const Selection& sound,
                    const std::vector<MeshConnectivity::VertexState>& vertex_states, const MeshCheckOptions& options,
                    MeshCheck& check) {
  const std::vector<Triangle>& triangles = sound.triangles();
  const std::vector<char> is_flat_triangle = mark_flat(positions, triangles);
  std::vector<std::uint32_t> spread;
  spread.reserve(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const Vec3f& position = positions[triangles[t][0]];
    if (is_flat_triangle[t] == 0) {
      spread.push_back(t);
    } else {
      check.flat_triangles.add({sound.number(t), sound.number(t), position, position});
    }
  }

  MeshComponents components = measure_components(positions, triangles, vertex_states);
  const bool is_tree_needed = options.self_intersections || (options.nesting && components.components.size() > 1);
  const TriangleTree tree(positions, triangles, is_tree_needed ? spread : std::vector<std::uint32_t>());
  if (options.self_intersections) {
    check.self_intersecting_triangles =
        count_in_pairs(positions, sound, find_meeting_pairs(positions, triangles, tree));
  }
  if (options.nesting) measure_nesting(positions, triangles, tree, components);
  check.components = std::move(components.components);
  if (options.nesting) judge_nesting(positions, check);
}

}  // namespace

void MeshDefect::add(const MeshPlace& place) {
  ++count;
  if (places.size() < max_places) places.push_back(place);
}

void MeshDefect::append(const MeshDefect& other) {
  count += other.count;
  const std::size_t taken = std::min(max_places - places.size(), other.places.size());
  places.insert(places.end(), other.places.begin(), other.places.begin() + static_cast<std::ptrdiff_t>(taken));
}

bool MeshDefects::none() const {
  const std::vector<NamedMeshDefect> kinds = list_defects(*this);
  return std::all_of(kinds.begin(), kinds.end(), [](const NamedMeshDefect& kind) { return kind.defect->count == 0; });
}

double MeshCheck::volume() const {
  return std::accumulate(components.begin(), components.end(), 0.0,
                         [](double sum, const MeshComponent& component) { return sum + component.volume; });
}

double MeshCheck::area() const {
  return std::accumulate(components.begin(), components.end(), 0.0,
                         [](double sum, const MeshComponent& component) { return sum + component.area; });
}

std::int64_t MeshCheck::genus() const {
  return std::accumulate(components.begin(), components.end(), std::int64_t{0},
                         [](std::int64_t sum, const MeshComponent& component) { return sum + component.genus; });
}

double MeshCheck::self_intersecting_share() const {
  if (triangles == 0) return 0.0;
  return static_cast<double>(self_intersecting_triangles.count) / static_cast<double>(triangles);
}

bool MeshCheck::is_sound(double max_self_intersecting_share) const {
  for (const NamedMeshDefect& kind : list_defects(*this)) {
    if (kind.defect != &self_intersecting_triangles && kind.defect->count > 0) return false;
  }
  return self_intersecting_share() <= max_self_intersecting_share;
}

MeshDefects find_mesh_defects(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
  return find_surface_defects(positions, triangles).defects;
}

MeshCheck check_mesh(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles,
                     const MeshCheckOptions& options) {
  MeshCheck check;
  check.vertices = positions.size();
  check.triangles = triangles.size();
  SurfaceDefects found = find_surface_defects(positions, triangles);
  check.defects = std::move(found.defects);
  if (!options.unused_vertices) check.defects.unused_vertices = {};

  const bool all_finite = check.defects.not_finite_vertices.count == 0;
  const Selection sound = select(triangles, [&](const Triangle& t) {
    if (std::max({t[0], t[1], t[2]}) >= positions.size() || is_degenerate(t)) return false;
    return all_finite || std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return positions[v].allFinite(); });
  });
  // Triangles that are left out leave holes.
  if (!all_finite) found.vertex_states = examine_connectivity(positions, sound.triangles()).vertex_states;
  check_geometry(positions, sound, found.vertex_states, options, check);
  return check;
}

}  // namespace particle_surface_tracker
