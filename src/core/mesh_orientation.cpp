#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <Eigen/Geometry>

#include "exact_triangles.h"
#include "particle_surface_tracker/core/mesh_validation.h"

namespace particle_surface_tracker {
namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

struct Component {
  std::vector<std::uint32_t> vertices, triangles;
  Eigen::AlignedBox3f box;
  double volume = 0.0;
  std::size_t parent = kNone;  ///< The smallest component around this one.
};

double signed_volume(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles,
                     const Component& component) {
  const Vec3d origin = positions[component.vertices.front()].cast<double>();
  double six_volumes = 0.0;
  for (const std::uint32_t t : component.triangles) {
    const Vec3d a = positions[triangles[t][0]].cast<double>() - origin;
    const Vec3d b = positions[triangles[t][1]].cast<double>() - origin;
    const Vec3d c = positions[triangles[t][2]].cast<double>() - origin;
    six_volumes += a.dot(b.cross(c));
  }
  return six_volumes / 6.0;
}

std::vector<Component> split_into_components(const TriangleMesh& mesh) {
  const std::shared_ptr<const VertexComponents> connected = mesh.components();
  const std::vector<std::uint32_t>& labels = connected->of_vertex;
  std::vector<Component> components(connected->count);
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    components[labels[v]].vertices.push_back(v);
    components[labels[v]].box.extend(mesh.positions()[v]);
  }
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    components[labels[mesh.triangles()[t][0]]].triangles.push_back(t);
  }
  for (Component& component : components) {
    component.volume = signed_volume(mesh.positions(), mesh.triangles(), component);
  }
  return components;
}

/// How often a closed component winds around a point.
int winding_number(const Vec3f& point, const TriangleMesh& mesh, const Component& component) {
  int winding = 0;
  for (const std::uint32_t t : component.triangles) {
    winding += crossing_above(mesh.positions(), mesh.triangles()[t], point);
  }
  return winding;
}

/// Whether `inner` lies in `outer`, by the vote of a few of its vertices: some may touch the other surface, or lie
/// beyond it where the two cross.
bool lies_inside(const TriangleMesh& mesh, const Component& inner, const Component& outer) {
  constexpr std::size_t kVotes = 5;
  std::size_t inside = 0;
  for (std::size_t vote = 0; vote < kVotes; ++vote) {
    const std::uint32_t vertex = inner.vertices[vote * (inner.vertices.size() - 1) / (kVotes - 1)];
    inside += winding_number(mesh.positions()[vertex], mesh, outer) != 0;
  }
  return 2 * inside > kVotes;
}

/// Finds the parents. Only components with a box inside the other's box are compared (of two equal boxes only the first
/// can be the outer one), so no circle of parents can arise.
void find_parents(const TriangleMesh& mesh, std::vector<Component>& components) {
  tbb::parallel_for(std::size_t{0}, components.size(), [&](std::size_t i) {
    Component& inner = components[i];
    for (std::size_t j = 0; j < components.size(); ++j) {
      const Component& outer = components[j];
      if (i == j || !outer.box.contains(inner.box) || (inner.box.contains(outer.box) && i < j)) continue;
      const bool is_smaller =
          inner.parent == kNone || std::abs(outer.volume) < std::abs(components[inner.parent].volume);
      if (is_smaller && lies_inside(mesh, inner, outer)) inner.parent = j;
    }
  });
}

std::string describe(const TriangleMesh& mesh, const Component& component, std::size_t index) {
  const Vec3f& p = mesh.positions()[component.vertices.front()];
  return fmt::format("component {} ({} triangles, with the vertex at ({:g}, {:g}, {:g}))", index,
                     component.triangles.size(), p.x(), p.y(), p.z());
}

}  // namespace

std::vector<std::string> orient_outward(TriangleMesh& mesh) {
  std::vector<Component> components = split_into_components(mesh);
  find_parents(mesh, components);

  std::vector<std::string> lines;
  std::vector<Triangle> triangles = mesh.triangles();
  bool any_turned = false;
  for (std::size_t i = 0; i < components.size(); ++i) {
    const Component& component = components[i];
    std::size_t root = i;
    while (components[root].parent != kNone) root = components[root].parent;
    if (components[root].volume < 0.0) {
      for (const std::uint32_t t : component.triangles) std::swap(triangles[t][1], triangles[t][2]);
      any_turned = true;
      lines.push_back(fmt::format("{} was turned: {}", describe(mesh, component, i),
                                  i == root ? "it was inside out" : "it lies in one that was inside out"));
    }
    if (component.parent == kNone || component.volume * components[component.parent].volume < 0.0) continue;
    lines.push_back(
        fmt::format("{} lies directly inside component {} and has the same orientation; it was left as it "
                    "is, turn or remove one of them if it is not meant",
                    describe(mesh, component, i), component.parent));
  }
  if (any_turned) mesh.set_triangles(std::move(triangles));
  return lines;
}

}  // namespace particle_surface_tracker
