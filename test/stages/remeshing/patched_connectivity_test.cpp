#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "stages/remeshing/patch.h"
#include "stages/remeshing/patched_connectivity.h"
#include "stages/upkeep/half_edges.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using remeshing::Patch;
using remeshing::PatchedConnectivity;
using remeshing::PatchVertex;

std::vector<std::uint32_t> twins_of(const std::vector<Triangle>& triangles, std::size_t vertex_count) {
  std::vector<std::uint32_t> twins;
  pair_half_edges(vertex_count, triangles, twins);
  return twins;
}

std::optional<PatchedConnectivity> patched(const TriangleMesh& mesh, const Patch& patch) {
  return remeshing::patched_connectivity(mesh.triangles(), twins_of(mesh.triangles(), mesh.vertex_count()), patch);
}

std::uint32_t add_vertex(Patch& patch) {
  return patch.add(PatchVertex::Kind::kCenter, {});
}

/// Takes the triangles around a vertex out, and puts a fan around a new vertex in their place.
Patch new_fan_around(const TriangleMesh& mesh, std::uint32_t vertex) {
  Patch patch(mesh.vertex_count());
  const std::uint32_t middle = add_vertex(patch);
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    Triangle triangle = mesh.triangles()[t];
    const auto corner = std::find(triangle.begin(), triangle.end(), vertex);
    if (corner == triangle.end()) continue;
    *corner = middle;
    patch.removed.push_back(t);
    patch.triangles.push_back(triangle);
  }
  return patch;
}

TEST(PatchedConnectivity, IsThatOfTheWholeResult) {
  const TriangleMesh mesh = test::make_sphere({0, 0, 0}, 1.0, 3);
  for (std::uint32_t vertex = 0; vertex < mesh.vertex_count(); vertex += 17) {
    const Patch patch = new_fan_around(mesh, vertex);
    const auto result = patched(mesh, patch);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->twins, twins_of(result->triangles, mesh.vertex_count() + 1));
    ASSERT_EQ(result->triangles.size(), mesh.triangle_count());
    EXPECT_TRUE(std::equal(patch.triangles.rbegin(), patch.triangles.rend(), result->triangles.rbegin()));
  }
}

TEST(PatchedConnectivity, TakesPartsAwayAndJoinsThem) {
  // Two tetrahedra; a face of either goes, and a tube of six triangles joins the holes.
  const TriangleMesh two({Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, 0, -1), Vec3f(0, 0, 1),
                          Vec3f(1, 0, 1), Vec3f(0, 1, 1), Vec3f(0, 0, 2)},
                         {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}, {4, 6, 5}, {4, 5, 7}, {5, 6, 7}, {6, 4, 7}});
  Patch tube(two.vertex_count());
  tube.removed = {0, 4};
  for (std::uint32_t k = 0; k < 3; ++k) {
    const std::uint32_t next = (k + 1) % 3;
    tube.triangles.insert(tube.triangles.end(), {{k, next, 4 + next}, {k, 4 + next, 4 + k}});
  }
  const auto joined = patched(two, tube);
  ASSERT_TRUE(joined);
  EXPECT_EQ(joined->triangles.size(), 12U);
  EXPECT_EQ(joined->twins, twins_of(joined->triangles, two.vertex_count()));

  Patch fewer(two.vertex_count());
  fewer.removed = {4, 5, 6, 7};
  const auto one = patched(two, fewer);
  ASSERT_TRUE(one);
  EXPECT_EQ(one->triangles.size(), 4U);

  Patch none(two.vertex_count());
  none.removed = {0, 1, 2, 3, 4, 5, 6, 7};
  ASSERT_TRUE(patched(two, none));
  EXPECT_TRUE(patched(two, none)->triangles.empty());
}

TEST(PatchedConnectivity, RefusesWhatIsNotClosedOrNotOriented) {
  const TriangleMesh mesh = test::make_sphere({0, 0, 0}, 1.0, 2);
  const Patch good = new_fan_around(mesh, 5);
  ASSERT_TRUE(patched(mesh, good));
  const auto expect_refused = [&](auto&& spoil) {
    Patch patch = good;
    spoil(patch);
    EXPECT_FALSE(patched(mesh, patch));
  };
  expect_refused([](Patch& patch) { patch.triangles.pop_back(); });
  expect_refused([](Patch& patch) { patch.removed.pop_back(); });
  expect_refused([](Patch& patch) { patch.triangles.push_back(patch.triangles.front()); });
  expect_refused([](Patch& patch) { std::swap(patch.triangles[1][0], patch.triangles[1][1]); });
  // A triangle that is no triangle, and one of a vertex that is not there.
  expect_refused([](Patch& patch) { patch.triangles.push_back({1, 1, 2}); });
  expect_refused([&](Patch& patch) {
    for (Triangle& t : patch.triangles)
      std::replace(t.begin(), t.end(), patch.first_vertex(), patch.first_vertex() + 1);
  });
  // Two triangles that have nothing between them.
  expect_refused([](Patch& patch) { patch.triangles.insert(patch.triangles.end(), {{0, 1, 2}, {2, 1, 0}}); });
}

TEST(PatchedConnectivity, RefusesASecondUmbrella) {
  // A tetrahedron that hangs on a vertex of the mesh: every edge has two triangles.
  const TriangleMesh mesh = test::make_sphere({0, 0, 0}, 1.0, 2);
  Patch patch(mesh.vertex_count());
  const std::uint32_t a = add_vertex(patch), b = add_vertex(patch), c = add_vertex(patch);
  patch.triangles = {{7, a, b}, {7, b, c}, {7, c, a}, {a, c, b}};
  EXPECT_FALSE(patched(mesh, patch));
  const std::uint32_t d = add_vertex(patch);
  for (Triangle& t : patch.triangles) std::replace(t.begin(), t.end(), 7U, d);
  EXPECT_TRUE(patched(mesh, patch));
}

TEST(PatchedConnectivity, RefusesAnEdgeOfFourTriangles) {
  // A double pyramid over a hexagon: above around vertex 6, below from vertex 3, with an edge from 3 to 0. What is
  // above is replaced by diagonals.
  const std::vector<Vec3f> positions(7, Vec3f(0, 0, 0));
  std::vector<Triangle> triangles;
  for (std::uint32_t k = 0; k < 6; ++k) triangles.push_back({k, (k + 1) % 6, 6});
  const std::vector<Triangle> below = {{1, 0, 3}, {2, 1, 3}, {0, 5, 3}, {5, 4, 3}};
  triangles.insert(triangles.end(), below.begin(), below.end());
  const TriangleMesh mesh(positions, triangles);
  const auto fill = [&](const std::vector<Triangle>& filling) {
    Patch patch(mesh.vertex_count());
    patch.removed = {0, 1, 2, 3, 4, 5};
    patch.triangles = filling;
    return patched(mesh, patch);
  };
  EXPECT_TRUE(fill({{0, 1, 2}, {0, 2, 4}, {2, 3, 4}, {0, 4, 5}}));
  // Around either end of the edge there is one umbrella of all triangles, which meets the other end twice.
  EXPECT_FALSE(fill({{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}));
}

TEST(PatchedConnectivity, OfAnOpenMeshChecksAll) {
  const TriangleMesh mesh = test::make_sphere({0, 0, 0}, 1.0, 2);
  std::vector<Triangle> open = mesh.triangles();
  const Triangle missing = open.back();
  open.pop_back();
  const std::vector<std::uint32_t> no_twins(3 * open.size(), kNoHalfEdge);
  Patch patch(mesh.vertex_count());
  EXPECT_FALSE(remeshing::patched_connectivity(open, no_twins, patch));
  patch.triangles = {missing};
  const auto closed = remeshing::patched_connectivity(open, no_twins, patch);
  ASSERT_TRUE(closed);
  EXPECT_EQ(closed->twins, twins_of(mesh.triangles(), mesh.vertex_count()));
}

}  // namespace
}  // namespace particle_surface_tracker
