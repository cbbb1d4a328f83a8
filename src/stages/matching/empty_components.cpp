#include "particle_surface_tracker/stages/empty_components.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <Eigen/Geometry>

#include "stages/nodes/lattice_cell.h"
#include "stages/nodes/node_masks.h"

namespace particle_surface_tracker {

namespace {

/// A component with more triangles is no crumb.
constexpr std::size_t kLargestCrumb = 500;

/// Liquid has a particle in the box of its surface, or as near as this [r].
constexpr double kNear = 0.3;

/// A component that encloses less is no drop and no bubble, whoever is near it [r³]: the motion flattens it, and once
/// it is inside out nothing finds it any more.
constexpr double kLargestSpeck = 1.0e-3;

struct Component {
  std::size_t triangles = 0;
  bool has_old = false;    ///< A vertex of the first mesh.
  bool has_fresh = false;  ///< A vertex of this frame.
  double six_volumes = 0.0;
  Vec3d origin = Vec3d::Zero();  ///< Of the volumes.
  Eigen::AlignedBox3d box;
};

std::vector<Component> describe_components(const TriangleMesh& mesh, const std::vector<std::uint32_t>& component_of,
                                           std::size_t count, std::uint32_t first_new_id,
                                           std::uint32_t first_fresh_id) {
  std::vector<Component> components(count);
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    Component& component = components[component_of[v]];
    if (mesh.ids()[v] < first_new_id) component.has_old = true;
    if (mesh.ids()[v] >= first_fresh_id) component.has_fresh = true;
  }
  for (const Triangle& t : mesh.triangles()) ++components[component_of[t[0]]].triangles;
  for (const Triangle& t : mesh.triangles()) {
    Component& component = components[component_of[t[0]]];
    const Vec3d a = mesh.positions()[t[0]].cast<double>();
    const Vec3d b = mesh.positions()[t[1]].cast<double>();
    const Vec3d c = mesh.positions()[t[2]].cast<double>();
    if (component.box.isEmpty()) component.origin = a;
    component.box.extend(a).extend(b).extend(c);
    component.six_volumes += (a - component.origin).dot((b - component.origin).cross(c - component.origin));
  }
  return components;
}

/// Whether another component may be inside one: without it, a cavity would be a cavity of nothing.
bool may_enclose(const std::vector<Component>& components, std::uint32_t number) {
  const Eigen::AlignedBox3d& box = components[number].box;
  for (std::uint32_t c = 0; c < components.size(); ++c) {
    if (c != number && components[c].triangles > 0 && box.contains(components[c].box)) return true;
  }
  return false;
}

}  // namespace

std::size_t remove_empty_components(TriangleMesh& mesh, std::uint32_t first_new_id, std::uint32_t first_fresh_id,
                                    const std::vector<Vec3f>& particles, double r) {
  const std::shared_ptr<const VertexComponents> connected = mesh.components();
  const std::vector<std::uint32_t>& component_of = connected->of_vertex;
  const std::size_t count = connected->count;
  if (count <= 1) return 0;
  const std::vector<Component> components =
      describe_components(mesh, component_of, count, first_new_id, first_fresh_id);
  std::vector<std::uint32_t> crumbs, specks;
  NodeMasks near;  // cells of r that are near crumbs
  for (std::uint32_t c = 0; c < count; ++c) {
    const Component& component = components[c];
    if (component.has_old && !component.has_fresh) continue;
    if (component.triangles > kLargestCrumb) continue;
    const bool is_speck = std::abs(component.six_volumes) < 6.0 * kLargestSpeck * r * r * r;
    if ((component.six_volumes <= 0.0 && !is_speck) || may_enclose(components, c)) continue;
    if (is_speck) {
      specks.push_back(c);
      continue;
    }
    crumbs.push_back(c);
    openvdb::CoordBBox cells(cell_of(component.box.min() / r), cell_of(component.box.max() / r));
    cells.expand(1);
    for (auto cell = cells.begin(); cell; ++cell) near.insert(*cell);
  }
  for (const Vec3f& particle : particles) {
    const Vec3d place = particle.cast<double>();
    if (!has_cell(place / r) || !near.contains(cell_of(place / r))) continue;
    crumbs.erase(std::remove_if(crumbs.begin(), crumbs.end(),
                                [&](std::uint32_t c) {
                                  return components[c].box.squaredExteriorDistance(place) <= kNear * kNear * r * r;
                                }),
                 crumbs.end());
  }
  const auto middle = static_cast<std::ptrdiff_t>(crumbs.size());
  crumbs.insert(crumbs.end(), specks.begin(), specks.end());
  std::inplace_merge(crumbs.begin(), crumbs.begin() + middle, crumbs.end());
  if (crumbs.empty()) return 0;
  std::vector<Triangle> kept;
  std::copy_if(mesh.triangles().begin(), mesh.triangles().end(), std::back_inserter(kept), [&](const Triangle& t) {
    return !std::binary_search(crumbs.begin(), crumbs.end(), component_of[t[0]]);
  });
  mesh.set_triangles(std::move(kept));
  mesh.remove_unused_vertices();
  return crumbs.size();
}

}  // namespace particle_surface_tracker
