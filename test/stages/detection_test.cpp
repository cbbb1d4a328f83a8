#include "particle_surface_tracker/stages/detection.h"

#include <set>

#include <gtest/gtest.h>

#include "stages/detection/triangle_cells.h"
#include "support/parameters.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

constexpr double r = 0.1;

/// A projection that moves every vertex of a mesh by `step`.
Projection moved_by(const TriangleMesh& mesh, const Vec3f& step) {
  Projection projection;
  for (const Vec3f& x : mesh.positions()) projection.positions.push_back(x + step);
  projection.distances.assign(mesh.vertex_count(), 0.0f);
  projection.status.assign(mesh.vertex_count(), ProjectionStatus::kFound);
  return projection;
}

TEST(Detection, BelowTauVerticesMoveAndNothingIsFlagged) {
  TriangleMesh mesh = test::make_sphere(Vec3d::Zero(), 0.5, 2);
  const Projection projection = moved_by(mesh, {0.04f, 0, 0});
  const Detection detection = apply_projection(mesh, projection, test::parameters_with_spacing(r));
  EXPECT_TRUE(detection.flagged_vertices.empty());
  EXPECT_TRUE(detection.flagged_cells.empty());
  EXPECT_EQ(mesh.positions(), projection.positions);
}

TEST(Detection, AboveTauAVertexIsPutBackAndTheCellsOfItsTrianglesAreFlagged) {
  TriangleMesh mesh = test::make_sphere(Vec3d::Zero(), 0.5, 2);
  const std::vector<Vec3f> before = mesh.positions();
  Projection projection = moved_by(mesh, Vec3f::Zero());
  projection.positions[7] += Vec3f(0, 0.0501f, 0);
  projection.positions[8] += Vec3f(0, 0.0499f, 0);
  const Detection detection = apply_projection(mesh, projection, test::parameters_with_spacing(r));
  ASSERT_EQ(detection.flagged_vertices, std::vector<std::uint32_t>{7});
  EXPECT_EQ(mesh.positions()[7], before[7]);
  EXPECT_EQ(mesh.positions()[8], projection.positions[8]);
  EXPECT_EQ(detection.unreached_vertices, 0u);

  // Every cell that a dense sampling of the vertex's triangles falls into is flagged, and none without a triangle near.
  const double h = 0.5 * r;
  const std::set<openvdb::Coord> flagged(detection.flagged_cells.begin(), detection.flagged_cells.end());
  ASSERT_EQ(flagged.size(), detection.flagged_cells.size());
  std::set<openvdb::Coord> sampled;
  for (const Triangle& t : mesh.triangles()) {
    if (t[0] != 7 && t[1] != 7 && t[2] != 7) continue;
    const Vec3d a = mesh.positions()[t[0]].cast<double>();
    const Vec3d b = mesh.positions()[t[1]].cast<double>();
    const Vec3d c = mesh.positions()[t[2]].cast<double>();
    for (int i = 0; i <= 200; ++i) {
      for (int j = 0; j <= 200 - i; ++j) {
        const Vec3d p = (a + (b - a) * (i / 200.0) + (c - a) * (j / 200.0)) / h;
        sampled.insert(openvdb::Coord(static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())),
                                      static_cast<int>(std::floor(p.z()))));
      }
    }
  }
  for (const openvdb::Coord& cell : sampled) EXPECT_TRUE(flagged.count(cell)) << cell;
  EXPECT_LE(flagged.size(), sampled.size() + 6) << "only cells that the triangles graze may come on top";
}

TEST(Detection, AVertexWithoutSurfaceIsFlaggedAndStays) {
  TriangleMesh mesh = test::make_box(Vec3d::Zero(), Vec3d::Ones());
  const std::vector<Vec3f> before = mesh.positions();
  Projection projection = moved_by(mesh, Vec3f::Zero());
  projection.status[2] = ProjectionStatus::kAbsent;
  projection.status[5] = ProjectionStatus::kNotFound;
  const Detection detection = apply_projection(mesh, projection, test::parameters_with_spacing(r));
  EXPECT_EQ(detection.flagged_vertices, (std::vector<std::uint32_t>{2, 5}));
  EXPECT_EQ(detection.unreached_vertices, 2u);
  EXPECT_EQ(mesh.positions(), before);
}

TEST(TriangleCells, OfATriangleInAPlaneOfTheLattice) {
  std::vector<openvdb::Coord> cells;
  append_triangle_cells({Vec3d(0.25, 0.25, 1), Vec3d(0.75, 0.25, 1), Vec3d(0.25, 0.75, 1)}, 1.0, cells);
  const std::set<openvdb::Coord> found(cells.begin(), cells.end());
  EXPECT_EQ(found, (std::set<openvdb::Coord>{{0, 0, 0}, {0, 0, 1}}));
}

TEST(TriangleCells, OfALargeSlantedTriangleLeaveOutTheRestOfItsBox) {
  std::vector<openvdb::Coord> cells;
  append_triangle_cells({Vec3d(0.5, 0.5, 0.5), Vec3d(9.5, 0.5, 0.5), Vec3d(0.5, 9.5, 9.5)}, 1.0, cells);
  const std::set<openvdb::Coord> found(cells.begin(), cells.end());
  EXPECT_TRUE(found.count({0, 9, 9}));
  EXPECT_TRUE(found.count({4, 2, 2}));
  EXPECT_FALSE(found.count({9, 9, 9}));
  EXPECT_FALSE(found.count({0, 0, 9}));
}

}  // namespace
}  // namespace particle_surface_tracker
