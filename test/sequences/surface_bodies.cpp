#include "sequences/surface_bodies.h"

#include <algorithm>
#include <map>

#include <tbb/parallel_for.h>

#include "sequences/disjoint_sets.h"
#include "sequences/mesh_judge.h"

namespace particle_surface_tracker::test {

namespace {

constexpr std::size_t kVoters = 9;

/// How often each component winds around a point; those that do not are left out.
std::map<std::uint32_t, int> windings_at(const SolidJudge& judge,
                                         const std::vector<std::uint32_t>& component_of_triangle, const Vec3f& point) {
  std::map<std::uint32_t, int> windings;
  for (const auto& [triangle, sign] : judge.crossings_above(point.cast<double>()))
    windings[component_of_triangle[triangle]] += sign;
  return windings;
}

}  // namespace

struct SurfaceBodies::Component {
  std::vector<std::uint32_t> vertices;
  std::vector<Triangle> triangles;
  double volume = 0.0;
};

SurfaceBodies::SurfaceBodies(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles)
    : judge_(positions, triangles) {
  std::vector<Component> components;
  find_components(positions, triangles, components);
  place_components(positions, components);
}

void SurfaceBodies::find_components(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles,
                                    std::vector<Component>& components) {
  DisjointSets sets(positions.size());
  std::vector<bool> is_used(positions.size(), false);
  for (const Triangle& t : triangles) {
    sets.merge(t[0], t[1]);
    sets.merge(t[0], t[2]);
    for (const std::uint32_t v : t) is_used[v] = true;
  }
  std::map<std::uint32_t, std::uint32_t> number_of_set;
  std::vector<std::uint32_t> component_of_vertex(positions.size(), kNone);
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    if (!is_used[v]) continue;
    const auto next = static_cast<std::uint32_t>(components.size());
    const auto [entry, is_new] = number_of_set.try_emplace(sets.find(v), next);
    if (is_new) components.emplace_back();
    component_of_vertex[v] = entry->second;
    components[entry->second].vertices.push_back(v);
  }
  for (const Triangle& t : triangles) {
    component_of_triangle_.push_back(component_of_vertex[t[0]]);
    components[component_of_triangle_.back()].triangles.push_back(t);
  }
  for (Component& component : components) {
    component.volume = enclosed_volume(positions, component.triangles);
    component.triangles = {};
  }
}

void SurfaceBodies::place_components(const std::vector<Vec3f>& positions, std::vector<Component>& components) {
  body_of_component_.assign(components.size(), kNone);
  for (std::uint32_t c = 0; c < components.size(); ++c) {
    if (components[c].volume <= 0.0) continue;
    body_of_component_[c] = static_cast<std::uint32_t>(body_count_++);
    body_vertices_.push_back(positions[components[c].vertices.front()]);
  }
  for (std::uint32_t c = 0; c < components.size(); ++c) {
    const std::vector<std::uint32_t>& vertices = components[c].vertices;
    std::vector<int> windings_around;
    std::map<std::uint32_t, std::size_t> votes;  // For every solid around the voters.
    const std::size_t voters = std::min(kVoters, vertices.size());
    for (std::size_t n = 0; n < voters; ++n) {
      int around = 0;
      const Vec3f& voter = positions[vertices[n * (vertices.size() - 1) / (voters - 1)]];
      for (const auto& [other, winding] : windings_at(judge_, component_of_triangle_, voter)) {
        if (other == c) continue;
        around += winding;
        if (winding > 0 && components[other].volume > 0.0) ++votes[other];
      }
      windings_around.push_back(around);
    }
    std::sort(windings_around.begin(), windings_around.end());
    const int around = windings_around[windings_around.size() / 2];
    if (components[c].volume > 0.0) {
      nested_solids_ += around > 0;
      continue;
    }
    ++cavities_;
    misplaced_cavities_ += around != 1;
    double smallest = 0.0;
    for (const auto& [solid, count] : votes) {
      if (2 * count <= voters) continue;
      if (body_of_component_[c] != kNone && components[solid].volume >= smallest) continue;
      smallest = components[solid].volume;
      body_of_component_[c] = body_of_component_[solid];
    }
  }
}

std::vector<std::uint32_t> SurfaceBodies::bodies_of(const Vec3f& point, double reach) const {
  std::map<std::uint32_t, int> windings;
  for (const auto& [component, winding] : windings_at(judge_, component_of_triangle_, point)) {
    if (body_of_component_[component] != kNone) windings[body_of_component_[component]] += winding;
  }
  std::vector<std::uint32_t> bodies;
  for (const auto& [body, winding] : windings) {
    if (winding > 0) bodies.push_back(body);
  }
  if (!bodies.empty() || component_of_triangle_.empty()) return bodies;
  const SolidJudge::Nearest nearest = judge_.nearest(point);
  const std::uint32_t body = body_of_component_[component_of_triangle_[nearest.triangle]];
  if (nearest.distance <= reach && body != kNone) bodies.push_back(body);
  return bodies;
}

std::vector<std::vector<std::uint32_t>> SurfaceBodies::bodies_of(const std::vector<Vec3f>& points, double reach) const {
  std::vector<std::vector<std::uint32_t>> bodies(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t n) { bodies[n] = bodies_of(points[n], reach); });
  return bodies;
}

}  // namespace particle_surface_tracker::test
