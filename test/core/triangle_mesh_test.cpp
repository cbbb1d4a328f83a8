#include "particle_surface_tracker/core/triangle_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

using ::testing::ElementsAre;

TriangleMesh two_triangles() {
  TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {9, 9, 9}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 3}, {0, 3, 4}});
  mesh.delta() = {0.0f, 0.1f, 0.9f, 0.3f, 0.4f};
  const std::size_t uv = mesh.attributes().add(TriangleMesh::texcoord_name, 2, {0.5f, 0.25f});
  mesh.attributes()[uv].values = {0, 0, 1, 0, 9, 9, 1, 1, 0, 1};
  return mesh;
}

TEST(TriangleMesh, IdsCountUpAndDeltaIsZero) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  EXPECT_THAT(mesh.ids(), ElementsAre(0, 1, 2));
  EXPECT_THAT(mesh.delta(), ElementsAre(0.0f, 0.0f, 0.0f));
  EXPECT_EQ(mesh.next_id(), 3u);
}

TEST(TriangleMesh, IdsCanBeGiven) {
  TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {7, 40, 3});
  EXPECT_THAT(mesh.ids(), ElementsAre(7, 40, 3));
  EXPECT_EQ(mesh.next_id(), 41u);
  EXPECT_THROW(TriangleMesh({{0, 0, 0}, {1, 0, 0}}, {}, {7}), MeshError);
  EXPECT_THROW(TriangleMesh({{0, 0, 0}, {1, 0, 0}}, {}, {7, 7}), MeshError);
}

TEST(TriangleMesh, ATriangleMustNameVerticesThatAreThere) {
  EXPECT_THROW(TriangleMesh({{0, 0, 0}}, {{0, 0, 1}}), MeshError);
  TriangleMesh mesh = two_triangles();
  EXPECT_THROW(mesh.set_triangles({{0, 1, 5}}), MeshError);
  EXPECT_EQ(mesh.triangle_count(), 2u);
}

TEST(TriangleMesh, UnusedVerticesGoAndEverythingFollows) {
  TriangleMesh mesh = two_triangles();
  mesh.remove_unused_vertices();
  EXPECT_EQ(mesh.vertex_count(), 4u);
  EXPECT_THAT(mesh.ids(), ElementsAre(0, 1, 3, 4));
  EXPECT_THAT(mesh.delta(), ElementsAre(0.0f, 0.1f, 0.3f, 0.4f));
  EXPECT_THAT(mesh.attributes()[1].values, ElementsAre(0, 0, 1, 0, 1, 1, 0, 1));
  EXPECT_THAT(mesh.triangles(), ElementsAre(Triangle{0, 1, 2}, Triangle{0, 2, 3}));
  EXPECT_EQ(mesh.positions()[2], Vec3f(1, 1, 0));
}

TEST(TriangleMesh, ANewVertexBlendsAttributesAndGetsAnIdThatNobodyHad) {
  TriangleMesh mesh = two_triangles();
  mesh.remove_unused_vertices();
  const std::uint32_t v = mesh.append_vertex({0.5f, 0.5f, 0.0f}, {{1, 0.5}, {3, 0.5}});
  EXPECT_EQ(v, 4u);
  EXPECT_EQ(mesh.ids().back(), 5u);
  EXPECT_FLOAT_EQ(mesh.delta().back(), 0.25f);
  EXPECT_FLOAT_EQ(mesh.attributes()[1].values[8], 0.5f);
  EXPECT_FLOAT_EQ(mesh.attributes()[1].values[9], 0.5f);
}

TEST(TriangleMesh, ConnectivityIsTheSameOnlyWhereTheTrianglesAre) {
  const TriangleMesh mesh({Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(5, 5, 5)}, {{0, 1, 2}});
  EXPECT_NE(mesh.connectivity(), 0U);
  TriangleMesh changed = mesh;
  EXPECT_EQ(changed.connectivity(), mesh.connectivity());
  changed.positions()[0] = Vec3f(9, 9, 9);
  changed.append_vertex(Vec3f(0, 0, 1), {{0, 1.0}});
  EXPECT_EQ(changed.connectivity(), mesh.connectivity());
  changed.remove_unused_vertices();
  const std::uint64_t without_unused = changed.connectivity();
  EXPECT_NE(without_unused, mesh.connectivity());
  changed.set_triangles({});
  EXPECT_NE(changed.connectivity(), without_unused);
  EXPECT_NE(TriangleMesh(mesh.positions(), mesh.triangles()).connectivity(), mesh.connectivity());
}

TEST(TriangleMesh, KeepsItsComponentsWhileTheTrianglesStay) {
  TriangleMesh mesh({Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(5, 5, 5)}, {{0, 1, 2}});
  const auto components = mesh.components();
  EXPECT_EQ(components->of_vertex, (std::vector<std::uint32_t>{0, 0, 0, 1}));
  EXPECT_EQ(components->count, 2U);
  mesh.positions()[0] = Vec3f(9, 9, 9);
  EXPECT_EQ(mesh.components(), components);
  EXPECT_EQ(TriangleMesh(mesh).components(), components);
  mesh.append_vertex(Vec3f(0, 0, 1), {{0, 1.0}});
  EXPECT_EQ(mesh.components()->count, 3U);
  mesh.remove_unused_vertices();
  EXPECT_EQ(mesh.components()->count, 1U);
  mesh.set_triangles({});
  EXPECT_EQ(mesh.components()->count, 3U);
  EXPECT_EQ(components->count, 2U);
}

TEST(VertexAttributes, LateAttributesAndLateVerticesGetTheInitialValue) {
  VertexAttributes attributes;
  attributes.add("first", 1, {7.0f});
  attributes.resize(2);
  const std::size_t second = attributes.add("second", 2, {1.0f, 2.0f});
  attributes.resize(3);
  attributes.append_blend({});
  EXPECT_THAT(attributes[0].values, ElementsAre(7, 7, 7, 7));
  EXPECT_THAT(attributes[second].values, ElementsAre(1, 2, 1, 2, 1, 2, 1, 2));
  attributes.resize(1);
  EXPECT_THAT(attributes[second].values, ElementsAre(1, 2));
}

TEST(VertexAttributes, AddingTwiceFindsTheFirstAndMustFitIt) {
  VertexAttributes attributes;
  const std::size_t index = attributes.add("speed", 3, {0, 0, 0});
  EXPECT_EQ(attributes.add("speed", 3, {1, 1, 1}), index);
  EXPECT_EQ(attributes.find("speed"), index);
  EXPECT_EQ(attributes.find("none such"), VertexAttributes::none);
  EXPECT_THROW(attributes.add("speed", 1, {0}), MeshError);
  EXPECT_THROW(attributes.add("nothing", 0, {}), MeshError);
  EXPECT_THROW(attributes.add("short", 3, {0}), MeshError);
}

}  // namespace
}  // namespace particle_surface_tracker
