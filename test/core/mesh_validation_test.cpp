#include "particle_surface_tracker/core/mesh_validation.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/mesh_measures.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Vec3d kOrigin = Vec3d::Zero();

std::string defects_of(const TriangleMesh& mesh) {
  return describe_mesh_defects(mesh.positions(), mesh.triangles());
}

TriangleMesh with_triangles(const TriangleMesh& mesh, std::vector<Triangle> triangles) {
  return TriangleMesh(mesh.positions(), std::move(triangles));
}

TriangleMesh unit_box() {
  return test::make_box({0, 0, 0}, {1, 1, 1});
}

TEST(CheckClosedManifold, AcceptsClosedMeshes) {
  EXPECT_NO_THROW(check_closed_manifold(unit_box()));
  EXPECT_NO_THROW(check_closed_manifold(test::turned(unit_box())));
  EXPECT_NO_THROW(check_closed_manifold(test::make_sphere(kOrigin, 1.0, 4)));
  EXPECT_NO_THROW(check_closed_manifold(test::make_torus(kOrigin, 1.0, 0.3, 40, 20)));
}

TEST(CheckClosedManifold, ThrowsItsText) {
  std::vector<Triangle> triangles = unit_box().triangles();
  triangles.pop_back();
  const TriangleMesh mesh = with_triangles(unit_box(), triangles);
  try {
    check_closed_manifold(mesh);
    FAIL() << "an open box was accepted";
  } catch (const MeshError& error) {
    EXPECT_THAT(error.what(), HasSubstr(defects_of(mesh)));
  }
}

TEST(CheckClosedManifold, NamesAnEmptyMesh) {
  EXPECT_THAT(defects_of(TriangleMesh()), HasSubstr("no triangles"));
}

TEST(CheckClosedManifold, CountsOpenEdges) {
  std::vector<Triangle> triangles = unit_box().triangles();
  triangles.erase(triangles.begin() + 5);
  const std::string text = defects_of(with_triangles(unit_box(), triangles));
  EXPECT_THAT(text, HasSubstr("3 edges are open"));
  EXPECT_EQ(text.find("orientation"), std::string::npos);
  EXPECT_EQ(text.find("non-manifold"), std::string::npos);
}

TEST(CheckClosedManifold, NamesTheFirstOpenEdgeWithItsPlace) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}, {{0, 1, 2}});
  EXPECT_THAT(defects_of(mesh), AllOf(HasSubstr("3 edges are open"),
                                      HasSubstr("between vertex 0 at (0, 0, 0) and vertex 1 at (1, 0, 0)")));
}

TEST(CheckClosedManifold, CountsFlippedEdges) {
  std::vector<Triangle> triangles = unit_box().triangles();
  std::swap(triangles[4][0], triangles[4][1]);
  const std::string text = defects_of(with_triangles(unit_box(), triangles));
  EXPECT_THAT(text, HasSubstr("3 edges lie between triangles of opposite orientation"));
  EXPECT_EQ(text.find("open"), std::string::npos);
}

TEST(CheckClosedManifold, CountsNonManifoldEdges) {
  // Two tetrahedra that share the edge (0, 1).
  const std::vector<Vec3f> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, -1}};
  const TriangleMesh mesh(positions,
                          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}, {0, 4, 1}, {0, 1, 5}, {1, 4, 5}, {0, 5, 4}});
  EXPECT_THAT(defects_of(mesh),
              AllOf(HasSubstr("1 edges are non-manifold"), HasSubstr("vertex 0 at (0, 0, 0) and vertex 1")));
}

TEST(CheckClosedManifold, CountsNonManifoldVertices) {
  // Two tetrahedra that share vertex 0 (a bow-tie).
  const std::vector<Vec3f> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  const TriangleMesh mesh(positions,
                          {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}, {0, 4, 5}, {0, 6, 4}, {4, 6, 5}, {0, 5, 6}});
  const std::string text = defects_of(mesh);
  EXPECT_THAT(text, HasSubstr("1 vertices are non-manifold"));
  EXPECT_THAT(text, HasSubstr("vertex 0"));
  EXPECT_EQ(text.find("edges"), std::string::npos);
}

TEST(CheckClosedManifold, CountsDuplicateTriangles) {
  // Two triangles back to back: every edge is shared by two triangles of opposite directions.
  const TriangleMesh pillow({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}});
  EXPECT_THAT(defects_of(pillow), HasSubstr("1 triangles are there twice"));

  std::vector<Triangle> triangles = unit_box().triangles();
  triangles.push_back(triangles[3]);
  EXPECT_THAT(defects_of(with_triangles(unit_box(), triangles)),
              AllOf(HasSubstr("1 triangles are there twice"), HasSubstr("3 edges are non-manifold")));
}

TEST(CheckClosedManifold, CountsPositionsThatAreNotFinite) {
  TriangleMesh mesh = unit_box();
  mesh.positions()[3].y() = std::numeric_limits<float>::quiet_NaN();
  mesh.positions()[6].z() = -std::numeric_limits<float>::infinity();
  EXPECT_THAT(defects_of(mesh), AllOf(HasSubstr("2 vertices are not finite"), HasSubstr("vertex 3")));
}

TEST(CheckClosedManifold, CountsUnusedVerticesAndDegenerateTriangles) {
  TriangleMesh box = unit_box();
  std::vector<Vec3f> positions = box.positions();
  positions.emplace_back(5, 5, 5);
  EXPECT_THAT(defects_of(TriangleMesh(positions, box.triangles())),
              AllOf(HasSubstr("1 vertices belong to no triangle"), HasSubstr("vertex 8 at (5, 5, 5)")));
  std::vector<Triangle> triangles = box.triangles();
  triangles.push_back({1, 1, 2});
  EXPECT_THAT(defects_of(with_triangles(box, triangles)), HasSubstr("1 triangles are degenerate"));
}

TEST(CheckClosedManifold, NamesIndicesWithoutVertex) {
  EXPECT_THAT(describe_mesh_defects({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 2}}), HasSubstr("names vertex 2"));
}

double volume_of(const TriangleMesh& mesh) {
  return measure_mesh(mesh.positions(), mesh.triangles()).volume;
}

TEST(OrientOutward, LeavesAGoodMeshAlone) {
  TriangleMesh mesh = test::joined({test::make_sphere(kOrigin, 1.0, 3), test::make_box({2, 2, 2}, {3, 3, 3}),
                                    test::turned(test::make_sphere(kOrigin, 0.5, 2))});
  const std::vector<Triangle> before = mesh.triangles();
  EXPECT_THAT(orient_outward(mesh), IsEmpty());
  EXPECT_EQ(mesh.triangles(), before);
}

TEST(OrientOutward, TurnsAWholeMesh) {
  TriangleMesh mesh = test::turned(unit_box());
  EXPECT_EQ(orient_outward(mesh).size(), 1U);
  EXPECT_NEAR(volume_of(mesh), 1.0, 1e-12);
  check_closed_manifold(mesh);
}

TEST(OrientOutward, TurnsOnlyTheComponentsThatNeedIt) {
  TriangleMesh mesh = test::joined({unit_box(), test::turned(test::make_box({2, 0, 0}, {3, 1, 1}))});
  EXPECT_EQ(orient_outward(mesh).size(), 1U);
  EXPECT_NEAR(volume_of(mesh), 2.0, 1e-12);
}

TEST(OrientOutward, TurnsACavityTogetherWithItsSolid) {
  // A hollow ball, its drop inside the cavity, all inside out.
  const TriangleMesh good =
      test::joined({test::turned(test::make_box({1, 1, 1}, {3, 3, 3})), test::make_box({0, 0, 0}, {4, 4, 4}),
                    test::make_box({1.5, 1.5, 1.5}, {2, 2, 2})});
  TriangleMesh mesh = test::turned(good);
  EXPECT_EQ(orient_outward(mesh).size(), 3U);
  EXPECT_NEAR(volume_of(mesh), 64.0 - 8.0 + 0.125, 1e-9);
}

TEST(OrientOutward, LeavesASolidDirectlyInASolidAndSaysSo) {
  TriangleMesh mesh = test::joined({test::make_box({0, 0, 0}, {4, 4, 4}), test::make_box({1, 1, 1}, {3, 3, 3})});
  const std::vector<Triangle> before = mesh.triangles();
  const std::vector<std::string> lines = orient_outward(mesh);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_THAT(lines[0], HasSubstr("directly inside"));
  EXPECT_EQ(mesh.triangles(), before);
}

TEST(OrientOutward, ABoxInTheHoleOfATorusIsNotNested) {
  TriangleMesh mesh = test::joined(
      {test::turned(test::make_torus(kOrigin, 1.0, 0.3, 40, 20)), test::make_box({-0.2, -0.2, -0.2}, {0.2, 0.2, 0.2})});
  const double torus_volume = -volume_of(test::turned(test::make_torus(kOrigin, 1.0, 0.3, 40, 20)));
  EXPECT_EQ(orient_outward(mesh).size(), 1U);
  EXPECT_NEAR(volume_of(mesh), torus_volume + 0.064, 1e-6);
}

TEST(OrientOutward, SurvivesRaysThroughVerticesAndEdges) {
  // Rays from the vertices of the inner boxes meet vertices, edges and coplanar faces of the outer ones.
  const TriangleMesh outer = test::joined({test::make_box({0, 0, 0}, {4, 4, 4}), test::make_box({5, 0, 0}, {9, 4, 4})});
  TriangleMesh mesh = test::joined({outer, test::turned(test::make_box({1, 0.5, 0.5}, {2, 2, 2})),
                                    test::turned(test::make_box({6, 1, 1}, {8, 3, 3}))});
  EXPECT_THAT(orient_outward(mesh), IsEmpty());
  TriangleMesh inside_out = test::turned(mesh);
  EXPECT_EQ(orient_outward(inside_out).size(), 4U);
  EXPECT_NEAR(volume_of(inside_out), 128.0 - 2.25 - 8.0, 1e-9);
}

TEST(OrientOutward, TwoEqualComponentsDoNotNestInACircle) {
  TriangleMesh mesh = test::joined({test::turned(unit_box()), test::turned(unit_box())});
  orient_outward(mesh);
  EXPECT_NEAR(volume_of(mesh), 2.0, 1e-12);
}

}  // namespace
}  // namespace particle_surface_tracker
