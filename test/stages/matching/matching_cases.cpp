#include "matching_cases.h"

#include <algorithm>
#include <cmath>

#include "particle_surface_tracker/stages/surface_triangulation.h"
#include "stages/detection/triangle_cells.h"
#include "support/sampled_field.h"

namespace particle_surface_tracker::test::matching {

namespace {

template <typename Visit>
void for_each_node(Visit&& visit) {
  const openvdb::CoordBBox box(openvdb::Coord(-kHalfWidth), openvdb::Coord(kHalfWidth));
  for (auto node = box.begin(); node; ++node) visit(*node);
}

}  // namespace

Parameters make_parameters() {
  Parameters parameters;
  parameters.particle_spacing = kR;
  return parameters;
}

Body ball(const Vec3d& center, double radius) {
  return [=](const Vec3d& p) { return (p - center).norm() - radius; };
}

Body capsule(const Vec3d& from, const Vec3d& to, double radius) {
  return [=](const Vec3d& p) {
    const double along = (p - from).dot(to - from) / (to - from).squaredNorm();
    return (p - from - std::clamp(along, 0.0, 1.0) * (to - from)).norm() - radius;
  };
}

Body either(const Body& a, const Body& b) {
  return [=](const Vec3d& p) { return std::min(a(p), b(p)); };
}

Body without(const Body& a, const Body& b) {
  return [=](const Vec3d& p) { return std::max(a(p), -b(p)); };
}

ImplicitSurface make_surface(const Body& body, double dx) {
  ImplicitSurface surface;
  surface.dx = dx;
  surface.field = sample_cut_cells(body, dx, static_cast<int>(std::ceil(kHalfWidth * kH / dx)));
  surface.triangulation = triangulate_zero_level(*surface.field, dx);
  return surface;
}

TriangleMesh make_mesh(const Body& body) {
  const double dx = 0.53 * kH;
  const auto field = sample_cut_cells(body, dx, static_cast<int>(kHalfWidth * kH / dx));
  const SurfaceTriangulation surface = triangulate_zero_level(*field, dx);
  return {surface.vertices, surface.triangles};
}

std::vector<openvdb::Coord> cells_where(const TriangleMesh& mesh, const std::function<bool(const Vec3d&)>& condition) {
  std::vector<openvdb::Coord> cells;
  for (const Triangle& triangle : mesh.triangles()) {
    std::array<Vec3d, 3> corners;
    for (int i = 0; i < 3; ++i) corners[i] = mesh.positions()[triangle[i]].cast<double>();
    if (std::any_of(corners.begin(), corners.end(), condition)) append_triangle_cells(corners, kH, cells);
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

Vec3d place(const openvdb::Coord& node) {
  return Vec3d(node.x(), node.y(), node.z()) * kH;
}

Nodes nodes_inside(const Body& body) {
  Nodes nodes;
  for_each_node([&](const openvdb::Coord& node) {
    if (body(place(node)) < 0.0) nodes.insert(node);
  });
  return nodes;
}

Nodes nodes_inside(const MeshLattice& lattice, const MatchedVoxelization& matched) {
  Nodes nodes;
  for_each_node([&](const openvdb::Coord& node) {
    if (lattice.winding_number(node) >= 1) nodes.insert(node);
  });
  for (std::size_t n = 0; n < matched.nodes.size(); ++n) {
    if (matched.gamma[n] < 0.0f) {
      nodes.insert(matched.nodes[n]);
    } else {
      nodes.erase(matched.nodes[n]);
    }
  }
  return nodes;
}

int count_components(const Nodes& nodes) {
  Nodes left = nodes;
  int count = 0;
  while (!left.empty()) {
    std::vector<openvdb::Coord> reached = {*left.begin()};
    left.erase(left.begin());
    while (!reached.empty()) {
      const openvdb::Coord node = reached.back();
      reached.pop_back();
      for (int side = 0; side < 6; ++side) {
        openvdb::Coord neighbor = node;
        neighbor[side >> 1] += (side & 1) != 0 ? 1 : -1;
        if (left.erase(neighbor) != 0) reached.push_back(neighbor);
      }
    }
    ++count;
  }
  return count;
}

}  // namespace particle_surface_tracker::test::matching
