#include "particle_surface_tracker/core/mesh_check.h"

#include <limits>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

using Triangles = std::vector<Triangle>;

/// The kinds of defects that occur, with their counts.
std::map<std::string, std::size_t> counts_of(const MeshCheck& check) {
  std::map<std::string, std::size_t> counts;
  for (const NamedMeshDefect& kind : list_defects(check)) {
    if (kind.defect->count > 0) counts[kind.name] = kind.defect->count;
  }
  return counts;
}

MeshCheck check_of(const TriangleMesh& mesh) {
  return check_mesh(mesh.positions(), mesh.triangles());
}

MeshCheck welded_check_of(const TriangleMesh& mesh) {
  MeshCheckOptions options;
  options.unused_vertices = false;
  return check_mesh(mesh.positions(), weld_by_position(mesh.positions(), mesh.triangles()).triangles, options);
}

TriangleMesh unit_box() {
  return test::make_box({0, 0, 0}, {1, 1, 1});
}

TriangleMesh box(double center, double half_side) {
  return test::make_box(Vec3d::Constant(center - half_side), Vec3d::Constant(center + half_side));
}

/// A tetrahedron of the corner `a` and three others, outward.
const Triangles kTetrahedron = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};

TEST(CheckMesh, FindsNothingWrongWithGoodMeshes) {
  const std::vector<std::pair<TriangleMesh, std::int64_t>> meshes = {
      {unit_box(), 0},
      {test::make_sphere({5, 6, 7}, 1.0, 4), 0},
      {test::make_torus(Vec3d::Zero(), 1.0, 0.3, 40, 20), 1},
      {test::joined({unit_box(), test::make_torus({10, 0, 0}, 1.0, 0.3, 40, 20), test::make_sphere({0, 9, 0}, 1, 3)}),
       1}};
  for (const auto& [mesh, genus] : meshes) {
    const MeshCheck check = check_of(mesh);
    EXPECT_THAT(counts_of(check), ElementsAre());
    EXPECT_TRUE(check.is_sound());
    EXPECT_EQ(check.genus(), genus);
    EXPECT_EQ(check.vertices, mesh.vertex_count());
    EXPECT_EQ(check.triangles, mesh.triangle_count());
    EXPECT_TRUE(welded_check_of(mesh).is_sound());
  }
}

TEST(CheckMesh, MeasuresEveryComponent) {
  const MeshCheck check =
      check_of(test::joined({box(1000, 1), test::make_torus({0, 0, 0}, 1, 0.3, 40, 20), box(5, 2)}));
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
  Triangles triangles = unit_box().triangles();
  triangles.erase(triangles.begin() + 5);
  const MeshCheck check = check_mesh(unit_box().positions(), triangles);
  EXPECT_THAT(counts_of(check), ElementsAre(Pair("open_edges", 3U)));
  EXPECT_EQ(check.defects.open_edges.places.size(), 3U);
  EXPECT_FALSE(check.components.at(0).is_closed);
  EXPECT_EQ(check.components.at(0).volume, 0.0);
}

TEST(CheckMesh, FlippedTriangle) {
  Triangles triangles = unit_box().triangles();
  std::swap(triangles[4][0], triangles[4][1]);
  EXPECT_THAT(counts_of(check_mesh(unit_box().positions(), triangles)), ElementsAre(Pair("flipped_edges", 3U)));
}

TEST(CheckMesh, NonManifoldEdge) {
  // Two tetrahedra that share the edge (0, 1).
  const std::vector<Vec3f> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -1, 0}, {0, 0, -1}};
  Triangles triangles = kTetrahedron;
  triangles.insert(triangles.end(), {{0, 4, 1}, {0, 1, 5}, {1, 4, 5}, {0, 5, 4}});
  const MeshCheck check = check_mesh(positions, triangles);
  EXPECT_THAT(counts_of(check), ElementsAre(Pair("non_manifold_edges", 1U)));
  EXPECT_EQ(describe_place("edge", check.defects.non_manifold_edges.places.at(0)),
            "between vertex 0 at (0, 0, 0) and vertex 1 at (1, 0, 0)");
}

TEST(CheckMesh, NonManifoldVertex) {
  // Two tetrahedra that share vertex 0.
  const std::vector<Vec3f> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  Triangles triangles = kTetrahedron;
  triangles.insert(triangles.end(), {{0, 4, 5}, {0, 6, 4}, {4, 6, 5}, {0, 5, 6}});
  const MeshCheck check = check_mesh(positions, triangles);
  EXPECT_THAT(counts_of(check), ElementsAre(Pair("non_manifold_vertices", 1U)));
  EXPECT_EQ(check.defects.non_manifold_vertices.places.at(0).index, 0U);
  ASSERT_EQ(check.components.size(), 1U);
  EXPECT_TRUE(check.components[0].is_closed);
  EXPECT_FALSE(check.components[0].is_manifold);
}

TEST(CheckMesh, DegenerateTriangle) {
  Triangles triangles = unit_box().triangles();
  triangles.insert(triangles.begin(), {1, 1, 2});
  const MeshCheck check = check_mesh(unit_box().positions(), triangles);
  EXPECT_THAT(counts_of(check), ElementsAre(Pair("degenerate_triangles", 1U)));
  EXPECT_EQ(check.defects.degenerate_triangles.places.at(0).index, 0U);
  EXPECT_TRUE(check.components.at(0).is_manifold);
}

TEST(CheckMesh, DuplicateTriangles) {
  // Two triangles back to back close every edge.
  const std::vector<Vec3f> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_THAT(counts_of(check_mesh(corners, {{0, 1, 2}, {0, 2, 1}})),
              UnorderedElementsAre(Pair("duplicate_triangles", 1U), Pair("self_intersecting_triangles", 2U),
                                   Pair("components_without_volume", 1U)));

  Triangles triangles = unit_box().triangles();
  const Triangle third = triangles[3];
  triangles.push_back({third[1], third[2], third[0]});
  triangles.push_back({third[1], third[0], third[2]});
  triangles.push_back({100, 0, 1});  // The numbers of triangles stay those of the input.
  const MeshCheck check = check_mesh(unit_box().positions(), triangles);
  EXPECT_THAT(counts_of(check),
              UnorderedElementsAre(Pair("dangling_triangles", 1U), Pair("duplicate_triangles", 2U),
                                   Pair("non_manifold_edges", 3U), Pair("self_intersecting_triangles", 3U)));
  EXPECT_EQ(check.defects.duplicate_triangles.places.at(0).index, 12U);
  EXPECT_EQ(check.defects.duplicate_triangles.places.at(0).other, 3U);
  EXPECT_EQ(check.defects.duplicate_triangles.places.at(1).index, 13U);
}

TEST(CheckMesh, UnusedVertices) {
  std::vector<Vec3f> positions = unit_box().positions();
  positions.insert(positions.end(), {{5, 5, 5}, {6, 6, 6}});
  const MeshCheck check = check_mesh(positions, unit_box().triangles());
  EXPECT_THAT(counts_of(check), ElementsAre(Pair("unused_vertices", 2U)));
  EXPECT_EQ(describe_place("vertex", check.defects.unused_vertices.places.at(0)), "vertex 8 at (5, 5, 5)");
  EXPECT_EQ(check.components.size(), 1U);
  MeshCheckOptions options;
  options.unused_vertices = false;
  EXPECT_TRUE(check_mesh(positions, unit_box().triangles(), options).is_sound());
}

TEST(CheckMesh, PositionsThatAreNotFinite) {
  std::vector<Vec3f> positions = unit_box().positions();
  positions[3].y() = std::numeric_limits<float>::quiet_NaN();
  positions[6].z() = -std::numeric_limits<float>::infinity();
  const MeshCheck check = check_mesh(positions, unit_box().triangles());
  EXPECT_THAT(counts_of(check), ElementsAre(Pair("not_finite_vertices", 2U)));
  EXPECT_EQ(check.defects.not_finite_vertices.places.at(1).index, 6U);
  // Its triangles are left out of what is measured, so the rest has holes.
  ASSERT_EQ(check.components.size(), 1U);
  EXPECT_FALSE(check.components[0].is_closed);
}

TEST(CheckMesh, TrianglesWithoutVertices) {
  Triangles triangles = unit_box().triangles();
  triangles[2][1] = 77;
  const MeshCheck check = check_mesh(unit_box().positions(), triangles);
  EXPECT_THAT(counts_of(check), UnorderedElementsAre(Pair("dangling_triangles", 1U), Pair("open_edges", 3U)));
  EXPECT_EQ(check.defects.dangling_triangles.places.at(0).index, 2U);
  EXPECT_THAT(counts_of(check_mesh({}, {{0, 1, 2}})), ElementsAre(Pair("dangling_triangles", 1U)));
}

TEST(CheckMesh, FlatTriangle) {
  // A cube's face whose diagonal has a vertex in its middle that only one side uses.
  std::vector<Vec3f> positions = unit_box().positions();
  Triangles triangles = unit_box().triangles();
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
  EXPECT_THAT(counts_of(check), ElementsAre());
  EXPECT_EQ(check.self_intersecting_share(), 0.0);
}

TEST(CheckMesh, CountsSelfIntersectingTriangles) {
  // A thin bar through a cube, off the diagonals of its sides: its eight long triangles cross one triangle below and
  // one above.
  const TriangleMesh bar = test::make_box({0.4, -0.5, -2}, {0.6, -0.3, 2});
  const MeshCheck check = check_of(test::joined({box(0, 1), bar}));
  EXPECT_THAT(counts_of(check), ElementsAre(Pair("self_intersecting_triangles", 10U)));
  EXPECT_DOUBLE_EQ(check.self_intersecting_share(), 10.0 / 24.0);
  EXPECT_FALSE(check.is_sound());
  EXPECT_TRUE(check.is_sound(10.0 / 24.0));
  EXPECT_EQ(check.self_intersecting_triangles.places.size(), MeshDefect::max_places);
  EXPECT_LT(check.self_intersecting_triangles.places[0].index, 12U);
  EXPECT_GE(check.self_intersecting_triangles.places[0].other, 12U);
}

TEST(CheckMesh, TouchingIsIntersecting) {
  // The tip of a tetrahedron in the middle of a triangle of the cube, off its diagonal.
  const TriangleMesh touching({{0.25F, 0.5F, 1}, {0, 0, 2}, {1, 0, 2}, {0, 1, 2}}, kTetrahedron);
  EXPECT_EQ(check_of(test::joined({unit_box(), touching})).self_intersecting_triangles.count, 1U + 3U);
  TriangleMesh apart = touching;
  apart.positions()[0].z() = std::nextafter(1.0F, 2.0F);
  EXPECT_TRUE(check_of(test::joined({unit_box(), apart})).is_sound());
}

TEST(CheckMesh, FoldedTriangle) {
  // Two triangles at an edge, one folded exactly onto the other: a tetrahedron pressed flat.
  const std::vector<Vec3f> positions = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}};
  const MeshCheck check = check_mesh(positions, kTetrahedron);
  EXPECT_THAT(counts_of(check),
              UnorderedElementsAre(Pair("self_intersecting_triangles", 4U), Pair("components_without_volume", 1U)));
}

TEST(CheckMesh, TrianglesThatShareAVertexMayIntersect) {
  // A fan around vertex 0 whose last triangle dips through the first.
  const std::vector<Vec3f> positions = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 1, 1}, {0.5F, 0.5F, -1}};
  EXPECT_EQ(check_mesh(positions, {{0, 1, 2}, {0, 3, 4}}).self_intersecting_triangles.count, 2U);
  const std::vector<Vec3f> beside = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {-1, -1, 1}, {-0.5F, -0.5F, -1}};
  EXPECT_EQ(check_mesh(beside, {{0, 1, 2}, {0, 3, 4}}).self_intersecting_triangles.count, 0U);
}

TEST(CheckMesh, SoundNesting) {
  // A hollow ball with a drop in its cavity, that is hollow itself; a box in the hole of a torus.
  const TriangleMesh ball = test::joined({test::turned(box(0, 3)), box(0, 4), box(0, 2), test::turned(box(0, 1))});
  const MeshCheck check = check_of(ball);
  EXPECT_THAT(counts_of(check), ElementsAre());
  EXPECT_EQ(check.components[0].winding_around, 1);
  EXPECT_EQ(check.components[1].winding_around, 0);
  EXPECT_EQ(check.components[2].winding_around, 0);
  EXPECT_EQ(check.components[3].winding_around, 1);
  EXPECT_NEAR(check.volume(), 512.0 - 216.0 + 64.0 - 8.0, 1e-9);
  const TriangleMesh torus = test::make_torus(Vec3d::Zero(), 1.0, 0.3, 40, 20);
  EXPECT_TRUE(check_of(test::joined({torus, box(0, 0.2)})).is_sound());
}

TEST(CheckMesh, SolidInASolid) {
  const MeshCheck check = check_of(test::joined({box(0, 4), box(0, 2), box(20, 1)}));
  EXPECT_THAT(counts_of(check), ElementsAre(Pair("solids_in_solids", 1U)));
  EXPECT_EQ(check.solids_in_solids.places.at(0).index, 1U);
  EXPECT_EQ(check.solids_in_solids.places.at(0).position, Vec3f(-2, -2, -2));
}

TEST(CheckMesh, InsideOutComponents) {
  EXPECT_THAT(counts_of(check_of(test::turned(unit_box()))), ElementsAre(Pair("inside_out_components", 1U)));
  // A cavity in a cavity is in no liquid.
  const TriangleMesh cavities = test::joined({box(0, 4), test::turned(box(0, 3)), test::turned(box(0, 1))});
  const MeshCheck check = check_of(cavities);
  EXPECT_THAT(counts_of(check), ElementsAre(Pair("inside_out_components", 1U)));
  EXPECT_EQ(check.inside_out_components.places.at(0).index, 2U);
}

TEST(CheckMesh, CavityInTwoSolids) {
  const TriangleMesh mesh = test::joined({box(0, 4), box(0, 3), test::turned(box(0, 1))});
  EXPECT_THAT(counts_of(check_of(mesh)),
              UnorderedElementsAre(Pair("solids_in_solids", 1U), Pair("cavities_in_overlaps", 1U)));
}

TEST(CheckMesh, CrossingSolidsAreNotNested) {
  const TriangleMesh mesh =
      test::joined({test::make_sphere({0, 0, 0}, 1.0, 3), test::make_sphere({1.3, 0, 0}, 1.0, 3)});
  const MeshCheck check = check_of(mesh);
  EXPECT_GT(check.self_intersecting_triangles.count, 0U);
  EXPECT_EQ(counts_of(check).size(), 1U);
}

TEST(CheckMesh, AnOpenComponentContainsNothing) {
  Triangles shell = box(0, 4).triangles();
  shell.pop_back();
  const TriangleMesh mesh = test::joined({TriangleMesh(box(0, 4).positions(), shell), box(0, 1)});
  EXPECT_THAT(counts_of(check_of(mesh)), ElementsAre(Pair("open_edges", 3U)));
}

TEST(Weld, DoubledVerticesBecomeOne) {
  // A box as STL has it: every triangle with corners of its own, one of them with −0.
  const TriangleMesh shape = unit_box();
  std::vector<Vec3f> positions;
  Triangles triangles;
  for (const Triangle& t : shape.triangles()) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const std::uint32_t v : t) positions.push_back(shape.positions()[v]);
    triangles.push_back({first, first + 1, first + 2});
  }
  for (float& value : positions[17]) value = value == 0.0F ? -0.0F : value;
  const TriangleMesh soup(positions, triangles);
  EXPECT_EQ(check_of(soup).defects.open_edges.count, 36U);
  const WeldedTriangles welded = weld_by_position(positions, triangles);
  EXPECT_EQ(welded.merged_vertices, 36U - 8U);
  EXPECT_TRUE(welded_check_of(soup).is_sound());
  EXPECT_NEAR(welded_check_of(soup).volume(), 1.0, 1e-12);
}

TEST(Weld, TwoBoxesAtACornerBecomeNonManifold) {
  const TriangleMesh boxes = test::joined({box(-1, 1), box(1, 1)});
  EXPECT_TRUE(check_of(boxes).defects.none());
  const MeshCheck welded = welded_check_of(boxes);
  EXPECT_THAT(counts_of(welded), ElementsAre(Pair("non_manifold_vertices", 1U)));
  EXPECT_EQ(welded.components.size(), 1U);
}

TEST(Weld, AnEdgeWithoutLengthBecomesDegenerate) {
  TriangleMesh sphere = test::make_sphere(Vec3d::Zero(), 1.0, 2);
  const Triangle pinched = sphere.triangles()[7];
  sphere.positions()[pinched[1]] = sphere.positions()[pinched[0]];
  EXPECT_EQ(check_of(sphere).flat_triangles.count, 2U);
  EXPECT_TRUE(check_of(sphere).defects.none());
  const MeshCheck welded = welded_check_of(sphere);
  EXPECT_EQ(welded.defects.degenerate_triangles.count, 2U);
  EXPECT_TRUE(welded.components.at(0).is_manifold);
}

}  // namespace
}  // namespace particle_surface_tracker
