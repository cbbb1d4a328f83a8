#include "particle_surface_tracker/core/mesh_check.h"

#include <limits>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh_check_support.h"

namespace particle_surface_tracker {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

TEST(CheckMesh, FindsNothingWrongWithGoodMeshes) {
  const std::vector<std::pair<TriangleMesh, std::int64_t>> meshes = {
      {test::unit_box(), 0},
      {test::make_sphere({5, 6, 7}, 1.0, 4), 0},
      {test::make_torus(Vec3d::Zero(), 1.0, 0.3, 40, 20), 1},
      {test::joined(
           {test::unit_box(), test::make_torus({10, 0, 0}, 1.0, 0.3, 40, 20), test::make_sphere({0, 9, 0}, 1, 3)}),
       1}};
  for (const auto& [mesh, genus] : meshes) {
    const MeshCheck check = test::check_of(mesh);
    EXPECT_THAT(test::counts_of(check), ElementsAre());
    EXPECT_TRUE(check.is_sound());
    EXPECT_EQ(check.genus(), genus);
    EXPECT_EQ(check.vertices, mesh.vertex_count());
    EXPECT_EQ(check.triangles, mesh.triangle_count());
    EXPECT_TRUE(test::welded_check_of(mesh).is_sound());
  }
}

TEST(CheckMesh, MeasuresEveryComponent) {
  const MeshCheck check =
      test::check_of(test::joined({test::box(1000, 1), test::make_torus({0, 0, 0}, 1, 0.3, 40, 20), test::box(5, 2)}));
  ASSERT_EQ(check.components.size(), 3U);
  EXPECT_EQ(check.components[0].vertices, 8U);
  EXPECT_EQ(check.components[0].triangles, 12U);
  EXPECT_NEAR(check.components[0].volume, 8.0, 1e-12);
  EXPECT_NEAR(check.components[0].area, 24.0, 1e-12);
  EXPECT_EQ(check.components[0].genus, 0);
  EXPECT_EQ(check.components[1].first_vertex, 8U);
  EXPECT_EQ(check.components[1].genus, 1);
  EXPECT_NEAR(check.components[2].volume, 64.0, 1e-12);
  EXPECT_NEAR(check.volume(), 72.0 + check.components[1].volume, 1e-12);
  EXPECT_EQ(check.genus(), 1);
}

TEST(CheckMesh, OpenEdges) {
  test::Triangles triangles = test::unit_box().triangles();
  triangles.erase(triangles.begin() + 5);
  const MeshCheck check = check_mesh(test::unit_box().positions(), triangles);
  EXPECT_THAT(test::counts_of(check), ElementsAre(Pair("open_edges", 3U)));
  EXPECT_EQ(check.defects.open_edges.places.size(), 3U);
  EXPECT_FALSE(check.components.at(0).is_closed);
  EXPECT_EQ(check.components.at(0).volume, 0.0);
}

TEST(CheckMesh, FlippedTriangle) {
  test::Triangles triangles = test::unit_box().triangles();
  std::swap(triangles[4][0], triangles[4][1]);
  EXPECT_THAT(test::counts_of(check_mesh(test::unit_box().positions(), triangles)),
              ElementsAre(Pair("flipped_edges", 3U)));
}

TEST(CheckMesh, NonManifoldEdge) {
  // Two tetrahedra that share the edge (0, 1).
  const std::vector<Vec3f> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, -1}};
  test::Triangles triangles = test::kTetrahedron;
  triangles.insert(triangles.end(), {{0, 4, 1}, {0, 1, 5}, {1, 4, 5}, {0, 5, 4}});
  const MeshCheck check = check_mesh(positions, triangles);
  EXPECT_THAT(test::counts_of(check), ElementsAre(Pair("non_manifold_edges", 1U)));
  EXPECT_EQ(describe_place("edge", check.defects.non_manifold_edges.places.at(0)),
            "between vertex 0 at (0, 0, 0) and vertex 1 at (1, 0, 0)");
}

TEST(CheckMesh, NonManifoldVertex) {
  // Two tetrahedra that share vertex 0.
  const std::vector<Vec3f> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  test::Triangles triangles = test::kTetrahedron;
  triangles.insert(triangles.end(), {{0, 4, 5}, {0, 6, 4}, {4, 6, 5}, {0, 5, 6}});
  const MeshCheck check = check_mesh(positions, triangles);
  EXPECT_THAT(test::counts_of(check), ElementsAre(Pair("non_manifold_vertices", 1U)));
  EXPECT_EQ(check.defects.non_manifold_vertices.places.at(0).index, 0U);
  ASSERT_EQ(check.components.size(), 1U);
  EXPECT_TRUE(check.components[0].is_closed);
  EXPECT_FALSE(check.components[0].is_manifold);
}

TEST(CheckMesh, DegenerateTriangle) {
  test::Triangles triangles = test::unit_box().triangles();
  triangles.insert(triangles.begin(), {1, 1, 2});
  const MeshCheck check = check_mesh(test::unit_box().positions(), triangles);
  EXPECT_THAT(test::counts_of(check), ElementsAre(Pair("degenerate_triangles", 1U)));
  EXPECT_EQ(check.defects.degenerate_triangles.places.at(0).index, 0U);
  EXPECT_TRUE(check.components.at(0).is_manifold);
}

TEST(CheckMesh, DuplicateTriangles) {
  // Two triangles back to back close every edge.
  const std::vector<Vec3f> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_THAT(test::counts_of(check_mesh(corners, {{0, 1, 2}, {0, 2, 1}})),
              UnorderedElementsAre(Pair("duplicate_triangles", 1U), Pair("self_intersecting_triangles", 2U),
                                   Pair("components_without_volume", 1U)));

  test::Triangles triangles = test::unit_box().triangles();
  const Triangle third = triangles[3];
  triangles.push_back({third[1], third[2], third[0]});
  triangles.push_back({third[1], third[0], third[2]});
  triangles.push_back({100, 0, 1});  // The numbers of triangles stay those of the input.
  const MeshCheck check = check_mesh(test::unit_box().positions(), triangles);
  EXPECT_THAT(test::counts_of(check),
              UnorderedElementsAre(Pair("dangling_triangles", 1U), Pair("duplicate_triangles", 2U),
                                   Pair("non_manifold_edges", 3U), Pair("self_intersecting_triangles", 3U)));
  EXPECT_EQ(check.defects.duplicate_triangles.places.at(0).index, 12U);
  EXPECT_EQ(check.defects.duplicate_triangles.places.at(0).other, 3U);
  EXPECT_EQ(check.defects.duplicate_triangles.places.at(1).index, 13U);
}

TEST(CheckMesh, UnusedVertices) {
  std::vector<Vec3f> positions = test::unit_box().positions();
  positions.insert(positions.end(), {{5, 5, 5}, {6, 6, 6}});
  const MeshCheck check = check_mesh(positions, test::unit_box().triangles());
  EXPECT_THAT(test::counts_of(check), ElementsAre(Pair("unused_vertices", 2U)));
  EXPECT_EQ(describe_place("vertex", check.defects.unused_vertices.places.at(0)), "vertex 8 at (5, 5, 5)");
  EXPECT_EQ(check.components.size(), 1U);
  MeshCheckOptions options;
  options.unused_vertices = false;
  EXPECT_TRUE(check_mesh(positions, test::unit_box().triangles(), options).is_sound());
}

TEST(CheckMesh, PositionsThatAreNotFinite) {
  std::vector<Vec3f> positions = test::unit_box().positions();
  positions[3].y() = std::numeric_limits<float>::quiet_NaN();
  positions[6].z() = -std::numeric_limits<float>::infinity();
  const MeshCheck check = check_mesh(positions, test::unit_box().triangles());
  EXPECT_THAT(test::counts_of(check), ElementsAre(Pair("not_finite_vertices", 2U)));
  EXPECT_EQ(check.defects.not_finite_vertices.places.at(1).index, 6U);
  // Its triangles are left out of what is measured, so the rest has holes.
  ASSERT_EQ(check.components.size(), 1U);
  EXPECT_FALSE(check.components[0].is_closed);
}

TEST(CheckMesh, TrianglesWithoutVertices) {
  test::Triangles triangles = test::unit_box().triangles();
  triangles[2][1] = 77;
  const MeshCheck check = check_mesh(test::unit_box().positions(), triangles);
  EXPECT_THAT(test::counts_of(check), UnorderedElementsAre(Pair("dangling_triangles", 1U), Pair("open_edges", 3U)));
  EXPECT_EQ(check.defects.dangling_triangles.places.at(0).index, 2U);
  EXPECT_THAT(test::counts_of(check_mesh({}, {{0, 1, 2}})), ElementsAre(Pair("dangling_triangles", 1U)));
}

TEST(CheckMesh, FlatTriangle) {
  // A cube's face whose diagonal has a vertex in its middle that only one side uses.
  std::vector<Vec3f> positions = test::unit_box().positions();
  test::Triangles triangles = test::unit_box().triangles();
  const auto [a, b, c] = triangles[0];
  positions.push_back((positions[a] + positions[b]) / 2.0F);
  triangles[0] = {a, 8, c};
  triangles.insert(triangles.end(), {{8, b, c}, {a, b, 8}});
  const MeshCheck check = check_mesh(positions, triangles);
  EXPECT_EQ(check.flat_triangles.count, 1U);
  EXPECT_EQ(check.flat_triangles.places.at(0).index, 13U);
  EXPECT_TRUE(check.defects.none());
  EXPECT_NEAR(check.volume(), 1.0, 1e-12);
}

TEST(CheckMesh, EmptyMesh) {
  const MeshCheck check = check_mesh({}, {});
  EXPECT_THAT(test::counts_of(check), ElementsAre());
  EXPECT_EQ(check.self_intersecting_share(), 0.0);
}

}  // namespace
}  // namespace particle_surface_tracker
