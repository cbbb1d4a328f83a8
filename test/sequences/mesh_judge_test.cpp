#include "sequences/mesh_judge.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "sequences/solid_judge.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test {

namespace {

TriangleMesh make_cube(double center, double half_side) {
  return make_box(Vec3d::Constant(center - half_side), Vec3d::Constant(center + half_side));
}

/// A box with a cavity.
TriangleMesh make_hollow_cube() {
  return joined({make_cube(0, 4), turned(make_cube(0, 2))});
}

SolidJudge judge_of(const TriangleMesh& mesh) {
  return SolidJudge(mesh.positions(), mesh.triangles());
}

/// A flat grid of n × n squares of side 1 in the plane z = 0.
TriangleMesh make_sheet(std::uint32_t n) {
  std::vector<Vec3f> positions;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) positions.emplace_back(static_cast<float>(i), static_cast<float>(j), 0.0f);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j;
      const std::uint32_t b = a + n + 1;
      triangles.insert(triangles.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
    }
  }
  return TriangleMesh(std::move(positions), std::move(triangles));
}

}  // namespace

TEST(MeshJudge, FindsNothingWrongWithClosedShapes) {
  for (const TriangleMesh& mesh : {make_cube(0, 1), make_sphere(Vec3d::Zero(), 1, 3), make_hollow_cube(),
                                   make_torus(Vec3d::Zero(), 2, 1, 12, 8)}) {
    EXPECT_TRUE(find_surface_defects(mesh.vertex_count(), mesh.triangles()).none());
    EXPECT_EQ(count_self_intersecting_triangles(mesh.positions(), mesh.triangles()), 0u);
    EXPECT_EQ(count_inverted_triangles(mesh.positions(), mesh.triangles()), 0u);
  }
}

TEST(MeshJudge, CountsEveryKindOfDefect) {
  const TriangleMesh cube = make_cube(0, 1);
  std::vector<Triangle> open = cube.triangles();
  open.pop_back();
  EXPECT_EQ(find_surface_defects(8, open).open_edges, 3u);
  EXPECT_EQ(find_surface_defects(9, cube.triangles()).unused_vertices, 1u);

  std::vector<Triangle> flipped = cube.triangles();
  std::swap(flipped[0][1], flipped[0][2]);
  EXPECT_EQ(find_surface_defects(8, flipped).flipped_edges, 3u);

  std::vector<Triangle> doubled = cube.triangles();
  doubled.push_back(doubled[0]);
  EXPECT_EQ(find_surface_defects(8, doubled).non_manifold_edges, 3u);

  std::vector<Triangle> degenerate = cube.triangles();
  degenerate.push_back({0, 0, 1});
  EXPECT_EQ(find_surface_defects(8, degenerate).degenerate_triangles, 1u);
}

TEST(MeshJudge, SeesTwoUmbrellasAtOneVertex) {
  const TriangleMesh cubes = joined({make_cube(-1, 1), make_cube(1, 1)});
  std::vector<Triangle> triangles = cubes.triangles();
  // The upper corner of the first cube and the lower corner of the second are at the same place: make them one vertex.
  for (Triangle& t : triangles) {
    for (std::uint32_t& v : t) v = v == 8 ? 7 : v;
  }
  const SurfaceDefects defects = find_surface_defects(cubes.vertex_count(), triangles);
  EXPECT_EQ(defects.non_manifold_vertices, 1u);
  EXPECT_EQ(defects.unused_vertices, 1u);
  EXPECT_EQ(defects.open_edges + defects.non_manifold_edges + defects.flipped_edges, 0u);
}

TEST(MeshJudge, VolumesAreSigned) {
  const TriangleMesh cube = make_cube(100, 1);
  EXPECT_NEAR(enclosed_volume(cube.positions(), cube.triangles()), 8.0, 1e-9);
  const TriangleMesh inside_out = turned(cube);
  EXPECT_NEAR(enclosed_volume(inside_out.positions(), inside_out.triangles()), -8.0, 1e-9);
  const TriangleMesh hollow = make_hollow_cube();
  EXPECT_NEAR(enclosed_volume(hollow.positions(), hollow.triangles()), 512.0 - 64.0, 1e-9);
}

TEST(MeshJudge, CountsCrossingTriangles) {
  // A thin bar through the two triangles of the lower and of the upper side of a cube, off their diagonals: its own
  // eight side triangles cross the one triangle below and the one above that it passes through.
  const TriangleMesh bar = make_box(Vec3d(0.4, -0.5, -2), Vec3d(0.6, -0.3, 2));
  const TriangleMesh crossing = joined({make_cube(0, 1), bar});
  EXPECT_EQ(count_self_intersecting_triangles(crossing.positions(), crossing.triangles()), 8u + 2u);
  const TriangleMesh apart = joined({make_cube(0, 1), make_cube(5, 1)});
  EXPECT_EQ(count_self_intersecting_triangles(apart.positions(), apart.triangles()), 0u);
}

TEST(MeshJudge, RefusesToCountCrossingsOfWhatIsNoManifold) {
  std::vector<Triangle> triangles = make_cube(0, 1).triangles();
  triangles.push_back(triangles[0]);
  EXPECT_THROW(count_self_intersecting_triangles(make_cube(0, 1).positions(), triangles), std::invalid_argument);
}

TEST(MeshJudge, CountsTrianglesThatFaceBackwards) {
  TriangleMesh sheet = make_sheet(4);
  EXPECT_EQ(count_inverted_triangles(sheet.positions(), sheet.triangles()), 0u);
  // The middle vertex is pulled sideways over its right neighbour's column: of its six triangles, the two between it
  // and that column turn over, and so do those beside them that it passes.
  sheet.positions()[12].x() += 1.25f;
  std::size_t downwards = 0;
  for (const auto& [a, b, c] : sheet.triangles()) {
    const Vec3f& p = sheet.positions()[a];
    downwards += (sheet.positions()[b] - p).cross(sheet.positions()[c] - p).z() < 0.0f ? 1 : 0;
  }
  EXPECT_GT(downwards, 0u);
  EXPECT_EQ(count_inverted_triangles(sheet.positions(), sheet.triangles()), downwards);
}

TEST(MeshJudge, CountsClusters) {
  const TriangleMesh sheet = make_sheet(4);
  const auto clusters = [&](const std::vector<std::uint32_t>& members) {
    return count_clusters(sheet.vertex_count(), sheet.triangles(), members);
  };
  EXPECT_EQ(clusters({}), 0u);
  EXPECT_EQ(clusters({7}), 1u);
  EXPECT_EQ(clusters({0, 1, 2, 22, 23}), 2u);
  EXPECT_EQ(clusters({0, 2, 4}), 3u);
}

TEST(SolidJudge, SignsAreExactOnAlignedShapes) {
  const SolidJudge cube = judge_of(make_cube(0, 1));
  // Straight above and below corners, edges and diagonals of the triangles.
  EXPECT_EQ(cube.winding_number(Vec3f(0.0f, 0.0f, 0.0f)), 1);
  EXPECT_EQ(cube.winding_number(Vec3f(0.0f, 0.0f, -2.0f)), 0);
  EXPECT_EQ(cube.winding_number(Vec3f(0.0f, 0.0f, 2.0f)), 0);
  EXPECT_EQ(cube.winding_number(Vec3f(0.5f, 0.5f, -2.0f)), 0);
  EXPECT_EQ(cube.winding_number(Vec3f(1.0f, 1.0f, -2.0f)), 0);
  EXPECT_EQ(cube.winding_number(Vec3f(-1.0f, -1.0f, -2.0f)), 0);
  EXPECT_EQ(cube.winding_number(Vec3f(1.5f, 0.0f, 0.0f)), 0);
  EXPECT_EQ(cube.winding_number(Vec3f(std::nextafter(1.0f, 0.0f), 0.0f, 0.0f)), 1);
  EXPECT_EQ(cube.winding_number(Vec3f(std::nextafter(1.0f, 2.0f), 0.0f, 0.0f)), 0);
}

TEST(SolidJudge, CavitiesAreOutsideAndOverlapsInside) {
  const SolidJudge hollow = judge_of(make_hollow_cube());
  EXPECT_EQ(hollow.winding_number(Vec3f(0, 0, 0)), 0);
  EXPECT_EQ(hollow.winding_number(Vec3f(3, 0, 0)), 1);
  EXPECT_EQ(hollow.winding_number(Vec3f(5, 0, 0)), 0);
  const SolidJudge nested = judge_of(joined({make_cube(0, 4), make_cube(0, 2)}));
  EXPECT_EQ(nested.winding_number(Vec3f(0, 0, 0)), 2);
  const SolidJudge crossing = judge_of(joined({make_cube(0, 1), make_cube(1, 1)}));
  EXPECT_EQ(crossing.winding_number(Vec3f(0.5f, 0.5f, 0.5f)), 2);
  EXPECT_EQ(crossing.winding_number(Vec3f(-0.5f, -0.5f, -0.5f)), 1);
  EXPECT_EQ(crossing.winding_number(Vec3f(-0.5f, 1.5f, 0.5f)), 0);
}

TEST(SolidJudge, SpheresAgreeWithTheirRadius) {
  const double radius = 2.0;
  const SolidJudge ball = judge_of(make_sphere(Vec3d(0.3, 0.2, 0.1), radius, 5));
  for (std::int32_t n = 0; n < 2000; ++n) {
    const Vec3f p =
        3.0f * Vec3d(hash_noise(1, n, 0, 0, 0), hash_noise(1, n, 0, 0, 1), hash_noise(1, n, 0, 0, 2)).cast<float>();
    const double from_center = (p.cast<double>() - Vec3d(0.3, 0.2, 0.1)).norm();
    EXPECT_NEAR(ball.distance(p.cast<double>()), std::abs(from_center - radius), 0.005) << p.transpose();
    if (std::abs(from_center - radius) < 0.005) continue;
    EXPECT_EQ(ball.winding_number(p), from_center < radius ? 1 : 0) << p.transpose();
  }
}

TEST(SolidJudge, SharesCountPointsInsideOrNear) {
  const SolidJudge cube = judge_of(make_cube(0, 1));
  const std::vector<Vec3f> points = {{0, 0, 0}, {1.5f, 0, 0}, {1.75f, 0, 0}, {5, 0, 0}};
  EXPECT_DOUBLE_EQ(cube.covered_share(points, 0.0), 0.25);
  EXPECT_DOUBLE_EQ(cube.covered_share(points, 0.5), 0.5);
  EXPECT_DOUBLE_EQ(cube.covered_share(points, 1.0), 0.75);
  EXPECT_DOUBLE_EQ(cube.covered_share({}, 1.0), 1.0);
}

TEST(SolidJudge, AMeshWithoutTrianglesContainsNothing) {
  const SolidJudge nothing({}, {});
  EXPECT_EQ(nothing.winding_number(Vec3f(0, 0, 0)), 0);
}

}  // namespace particle_surface_tracker::test
