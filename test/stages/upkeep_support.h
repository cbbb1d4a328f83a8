#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "particle_surface_tracker/core/triangle_mesh.h"
#include "particle_surface_tracker/stages/upkeep.h"
#include "sequences/mesh_judge.h"
#include "support/detailed_body.h"

namespace particle_surface_tracker::test {

/// Parameters with a cell size of Γ of h [m].
inline Parameters parameters_for_cells_of(double h) {
  Parameters parameters;
  parameters.particle_spacing = h / parameters.dx_gamma;
  return parameters;
}

struct MeshShape {
  double shortest_edge = std::numeric_limits<double>::max();   ///< [m].
  double longest_edge = 0.0;                                   ///< [m].
  double smallest_angle = std::numeric_limits<double>::max();  ///< [deg].
  double share_below_10_degrees = 0.0;                         ///< Of the triangles.
  double largest_fold = 0.0;                                   ///< [deg], between the normals at an edge.
};

inline double degrees(double radians) {
  return radians * 180.0 / 3.14159265358979323846;
}

/// Sizes and angles by the plainest formulas.
inline MeshShape shape_of(const TriangleMesh& mesh) {
  MeshShape shape;
  std::vector<std::tuple<std::uint32_t, std::uint32_t, std::size_t>> edges;
  const auto at = [&](std::uint32_t v) -> Vec3d { return mesh.positions()[v].cast<double>(); };
  const auto normal = [&](std::size_t t) -> Vec3d {
    const auto& [a, b, c] = mesh.triangles()[t];
    return (at(b) - at(a)).cross(at(c) - at(a));
  };
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    double smallest = 180.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles()[t][k];
      const std::uint32_t b = mesh.triangles()[t][(k + 1) % 3];
      const std::uint32_t c = mesh.triangles()[t][(k + 2) % 3];
      const Vec3d ab = at(b) - at(a), ac = at(c) - at(a);
      shape.shortest_edge = std::min(shape.shortest_edge, ab.norm());
      shape.longest_edge = std::max(shape.longest_edge, ab.norm());
      smallest = std::min(smallest, degrees(std::atan2(ab.cross(ac).norm(), ab.dot(ac))));
      edges.emplace_back(std::min(a, b), std::max(a, b), t);
    }
    shape.smallest_angle = std::min(shape.smallest_angle, smallest);
    if (smallest < 10.0) shape.share_below_10_degrees += 1.0 / static_cast<double>(mesh.triangle_count());
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t n = 0; n + 1 < edges.size(); n += 2) {
    const Vec3d first = normal(std::get<2>(edges[n])), second = normal(std::get<2>(edges[n + 1]));
    shape.largest_fold =
        std::max(shape.largest_fold, degrees(std::atan2(first.cross(second).norm(), first.dot(second))));
  }
  return shape;
}

/// Moves every vertex.
template <typename Motion>
void move_vertices(TriangleMesh& mesh, Motion&& motion) {
  for (Vec3f& position : mesh.positions()) position = motion(Vec3d(position.cast<double>())).template cast<float>();
}

inline TriangleMesh make_tetrahedron(double size) {
  const auto s = static_cast<float>(size);
  return TriangleMesh({{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
}

inline void scale(TriangleMesh& mesh, const Vec3d& factors) {
  move_vertices(mesh, [&](const Vec3d& x) { return Vec3d(x.cwiseProduct(factors)); });
}

inline double volume_of(const TriangleMesh& mesh) {
  return enclosed_volume(mesh.positions(), mesh.triangles());
}

inline SurfaceDefects defects_of(const TriangleMesh& mesh) {
  return find_surface_defects(mesh.vertex_count(), mesh.triangles());
}

/// A body with needles and folds of its own; made once, for that takes a second.
inline const TriangleMesh& detailed_mesh() {
  static const TriangleMesh mesh = DetailedBody(0.1).mesh();
  return mesh;
}

inline void expect_same_bits(const TriangleMesh& a, const TriangleMesh& b) {
  EXPECT_EQ(a.positions(), b.positions());
  EXPECT_EQ(a.triangles(), b.triangles());
  EXPECT_EQ(a.ids(), b.ids());
  ASSERT_EQ(a.attributes().count(), b.attributes().count());
  for (std::size_t n = 0; n < a.attributes().count(); ++n)
    EXPECT_EQ(a.attributes()[n].values, b.attributes()[n].values);
}

}  // namespace particle_surface_tracker::test
