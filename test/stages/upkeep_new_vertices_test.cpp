#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "particle_surface_tracker/stages/upkeep.h"
#include "support/detailed_body.h"
#include "support/shapes.h"
#include "upkeep_support.h"

namespace particle_surface_tracker {
namespace {

/// Distances of new vertices to the surface that they belong to.
struct Offsets {
  double mean = 0.0, largest = 0.0;

  template <typename Distance>
  Offsets(const TriangleMesh& mesh, const UpkeepReport& report, Distance&& distance) {
    for (const std::uint32_t v : report.fresh) {
      const double offset = std::abs(distance(Vec3d(mesh.positions()[v].cast<double>())));
      mean += offset / static_cast<double>(report.fresh.size());
      largest = std::max(largest, offset);
    }
  }
};

TEST(UpkeepNewVertices, PutsNewVerticesOnTheSmoothSurfaceOfARegularMesh) {
  TriangleMesh mesh = test::make_torus(Vec3d::Zero(), 1.0, 0.4, 100, 40);
  note_birth(mesh);
  test::scale(mesh, Vec3d::Constant(2.0625));
  const UpkeepReport report = keep_up(mesh, test::parameters_for_cells_of(0.05));
  EXPECT_EQ(report.splits, 4000U) << "the longest edge of every vertex: the diagonals, each once";
  const Offsets offsets(
      mesh, report, [](const Vec3d& x) { return std::hypot(std::hypot(x.x(), x.y()) - 2.0625, x.z()) - 0.4 * 2.0625; });
  // The middles of the diagonals lie up to 3.0e-3 below the surface.
  EXPECT_LT(offsets.largest, 3e-5);
}

TEST(UpkeepNewVertices, PutsNewVerticesNearTheSmoothSurfaceOfAnIrregularMesh) {
  TriangleMesh mesh = test::make_sphere(Vec3d::Zero(), 1.0, 4);
  note_birth(mesh);
  test::scale(mesh, Vec3d::Constant(2.5));
  const UpkeepReport report = keep_up(mesh, test::parameters_for_cells_of(0.1));
  ASSERT_GT(report.splits, 1000U);
  const Offsets offsets(mesh, report, [](const Vec3d& x) { return x.norm() - 2.5; });
  // The middles of the edges lie up to 4.6e-3 below the sphere, 3.6e-3 on average. The butterfly is not exact here: the
  // triangles change their shape abruptly where the octahedron had its edges, and what is split again has a vertex of
  // valence 4 with unequal edges.
  EXPECT_LT(offsets.mean, 7e-4);
  EXPECT_LT(offsets.largest, 3.5e-3);
}

TEST(UpkeepNewVertices, AttributesFollowAndUntouchedVerticesKeepEverything) {
  TriangleMesh mesh = test::detailed_mesh();
  const std::size_t texcoord = mesh.attributes().add(TriangleMesh::texcoord_name, 2, {0.0F, 0.0F});
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    mesh.delta()[v] = static_cast<float>(v);
    mesh.attributes()[texcoord].values[2 * v] = mesh.positions()[v].x();
    mesh.attributes()[texcoord].values[2 * v + 1] = mesh.positions()[v].y();
  }
  note_birth(mesh);
  const TriangleMesh before = mesh;
  const Vec3d center = test::DetailedBody(0.1).center();
  // Only one side is drawn out, to four times its length at the far end.
  test::move_vertices(mesh, [&](const Vec3d& x) {
    const double out = x.x() - center.x();
    return Vec3d(x + (out > 0.0 ? out * out : 0.0) * Vec3d::UnitX());
  });
  const TriangleMesh moved = mesh;
  const UpkeepReport report = keep_up(mesh, test::parameters_for_cells_of(0.05));
  ASSERT_GT(report.splits, 100U);
  EXPECT_TRUE(test::defects_of(mesh).none());

  std::vector<std::uint32_t> fresh;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const std::uint32_t id = mesh.ids()[v];
    EXPECT_TRUE(v == 0 || id > mesh.ids()[v - 1]) << "the order is kept, and new vertices come last";
    if (id >= before.vertex_count() || mesh.positions()[v] != moved.positions()[id]) {
      fresh.push_back(v);
      // Coordinates at rest, carried as texture coordinates, stay those of the place that the vertex is at.
      EXPECT_NEAR(mesh.attributes()[texcoord].values[2 * v + 1], mesh.positions()[v].y(), 0.03);
    } else {
      EXPECT_EQ(mesh.delta()[v], before.delta()[id]);
      EXPECT_EQ(mesh.attributes()[texcoord].values[2 * v], before.attributes()[texcoord].values[2 * id]);
    }
  }
  EXPECT_EQ(report.fresh, fresh);
}

}  // namespace
}  // namespace particle_surface_tracker
