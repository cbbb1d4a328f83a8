#include "mesh_components.h"

#include <algorithm>
#include <array>
#include <limits>

#include <tbb/parallel_for.h>
#include <Eigen/Geometry>

#include "exact_triangles.h"
#include "particle_surface_tracker/core/vertex_components.h"

namespace particle_surface_tracker {
namespace {

/// Vertices of a component that vote on what it lies in; odd, so that there is a median.
constexpr std::size_t kVotes = 9;

/// Adds up volumes and areas. Volumes are measured from the first vertex of the component, so that one far from the
/// origin loses no digits.
void add_triangles(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles,
                   MeshComponents& components) {
  for (const Triangle& t : triangles) {
    MeshComponent& component = components.components[components.of_vertex[t[0]]];
    const Vec3d origin = positions[component.first_vertex].cast<double>();
    const Vec3d a = positions[t[0]].cast<double>();
    const Vec3d normal = (positions[t[1]].cast<double>() - a).cross(positions[t[2]].cast<double>() - a);
    ++component.triangles;
    component.volume += normal.dot(a - origin) / 6.0;
    component.area += normal.norm() / 2.0;
  }
}

/// The vertices of every component that vote, evenly spread over its vertices.
std::vector<std::vector<std::uint32_t>> choose_voters(const MeshComponents& components,
                                                      const std::vector<char>& is_used) {
  std::vector<std::vector<std::uint32_t>> voters(components.components.size());
  std::vector<std::size_t> seen(voters.size(), 0);
  for (std::uint32_t v = 0; v < components.of_vertex.size(); ++v) {
    if (is_used[v] == 0) continue;
    const std::uint32_t c = components.of_vertex[v];
    const std::size_t last = components.components[c].vertices - 1;
    const std::size_t next = voters[c].size() * last / (kVotes - 1);
    if (voters[c].size() < kVotes && seen[c]++ >= next) voters[c].push_back(v);
  }
  return voters;
}

std::vector<char> mark_used(std::size_t vertex_count, const std::vector<Triangle>& triangles) {
  std::vector<char> is_used(vertex_count, 0);
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) is_used[v] = 1;
  }
  return is_used;
}

}  // namespace

MeshComponents measure_components(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles,
                                  const std::vector<MeshConnectivity::VertexState>& vertex_states) {
  MeshComponents found;
  VertexComponents labels = vertex_components(positions.size(), triangles);
  found.of_vertex = std::move(labels.of_vertex);

  // Vertices without triangles are labelled too; they get no component.
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  const std::vector<char> is_used = mark_used(positions.size(), triangles);
  std::vector<std::uint32_t> component_of_label(labels.count, kNone);
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    if (is_used[v] == 0) continue;
    std::uint32_t& c = component_of_label[found.of_vertex[v]];
    if (c == kNone) {
      c = static_cast<std::uint32_t>(found.components.size());
      found.components.push_back({});
      found.components.back().first_vertex = v;
      found.components.back().is_closed = found.components.back().is_manifold = true;
    }
    found.of_vertex[v] = c;
    MeshComponent& component = found.components[c];
    ++component.vertices;
    if (vertex_states[v] == MeshConnectivity::kBadEdge) component.is_closed = false;
    if (vertex_states[v] != MeshConnectivity::kGood) component.is_manifold = false;
  }

  add_triangles(positions, triangles, found);
  for (MeshComponent& component : found.components) {
    if (!component.is_closed) component.volume = 0.0;
    // χ = V − E + F with E = 3/2 F on a closed surface, and χ = 2 − 2 genus.
    const auto two_chi =
        2 * static_cast<std::int64_t>(component.vertices) - static_cast<std::int64_t>(component.triangles);
    if (component.is_manifold) component.genus = (4 - two_chi) / 4;
  }
  return found;
}

void measure_nesting(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles,
                     const TriangleTree& tree, MeshComponents& components) {
  if (components.components.size() < 2) return;
  const auto voters = choose_voters(components, mark_used(positions.size(), triangles));
  tbb::parallel_for(std::size_t{0}, voters.size(), [&](std::size_t c) {
    if (!components.components[c].is_closed) return;
    std::vector<int> votes;
    for (const std::uint32_t voter : voters[c]) {
      int winding = 0;
      tree.for_each_above(positions[voter], [&](std::uint32_t t) {
        const std::uint32_t other = components.of_vertex[triangles[t][0]];
        if (other == c || !components.components[other].is_closed) return;
        winding += crossing_above(positions, triangles[t], positions[voter]);
      });
      votes.push_back(winding);
    }
    const auto median = votes.begin() + static_cast<std::ptrdiff_t>(votes.size() / 2);
    std::nth_element(votes.begin(), median, votes.end());
    components.components[c].winding_around = *median;
  });
}

}  // namespace particle_surface_tracker
