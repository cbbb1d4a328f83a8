// Crossing triangles beside new folds, against the mesh checker's exact count.

#include "particle_surface_tracker/stages/untangling.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "particle_surface_tracker/core/mesh_check.h"
#include "stages/upkeep_support.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

std::size_t crossing_triangles(const TriangleMesh& mesh) {
  return check_mesh(mesh.positions(), mesh.triangles()).self_intersecting_triangles.count;
}

TriangleMesh sphere_at_birth() {
  TriangleMesh mesh = test::make_sphere(Vec3d::Zero(), 1.0, 4);
  note_birth(mesh);
  return mesh;
}

/// Moves vertex 20 by `reach` times its longest edge towards one of its neighbours, and so past it.
void push_past_a_neighbor(TriangleMesh& mesh, float reach) {
  const std::uint32_t v = 20;
  for (const Triangle& t : mesh.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (t[k] != v) continue;
      mesh.positions()[v] += reach * (mesh.positions()[t[(k + 1) % 3]] - mesh.positions()[v]);
      return;
    }
  }
}

TEST(Untangling, RelaxesAVertexThatWasPushedPastANeighbor) {
  TriangleMesh mesh = sphere_at_birth();
  push_past_a_neighbor(mesh, 1.8F);
  ASSERT_GT(crossing_triangles(mesh), 0U);
  const TriangleMesh before = mesh;
  UpkeepMemory memory;
  const UntanglingReport report = untangle(mesh, memory);
  EXPECT_EQ(report.tangles, 1U);
  EXPECT_EQ(report.untangled, 1U);
  EXPECT_EQ(crossing_triangles(mesh), 0U);
  EXPECT_EQ(mesh.triangles(), before.triangles());
  EXPECT_EQ(mesh.ids(), before.ids());
  std::vector<std::uint32_t> moved;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (mesh.positions()[v] == before.positions()[v]) continue;
    moved.push_back(v);
    EXPECT_LT((mesh.positions()[v] - before.positions()[20]).norm(), 0.5F);
  }
  EXPECT_EQ(report.moved, moved);
  EXPECT_LT(moved.size(), 40U);
}

TEST(Untangling, LeavesAMeshWithoutNewFoldsAloneBitForBit) {
  TriangleMesh mesh = sphere_at_birth();
  const TriangleMesh before = mesh;
  UpkeepMemory memory;
  EXPECT_EQ(untangle(mesh, memory).tangles, 0U);
  EXPECT_EQ(mesh.positions(), before.positions());
}

TEST(Untangling, LeavesTanglesOfBirthAlone) {
  TriangleMesh mesh = test::make_sphere(Vec3d::Zero(), 1.0, 4);
  push_past_a_neighbor(mesh, 1.8F);
  note_birth(mesh);
  ASSERT_GT(crossing_triangles(mesh), 0U);
  const TriangleMesh before = mesh;
  UpkeepMemory memory;
  EXPECT_EQ(untangle(mesh, memory).tangles, 0U);
  EXPECT_EQ(mesh.positions(), before.positions());
}

/// Some vertices, drawn at random, moved by up to `amount` along each axis.
TriangleMesh make_soup(int count, float amount) {
  TriangleMesh mesh = sphere_at_birth();
  std::mt19937 random(11);
  for (int n = 0; n < count; ++n) {
    Vec3f& x = mesh.positions()[random() % mesh.vertex_count()];
    for (int k = 0; k < 3; ++k) x[k] += amount * (static_cast<float>(random()) / 2147483648.0F - 1.0F);
  }
  return mesh;
}

TEST(Untangling, WhatItCannotMendStaysWhereItWas) {
  TriangleMesh mesh = make_soup(2000, 0.7F);
  const TriangleMesh before = mesh;
  UpkeepMemory memory;
  const UntanglingReport report = untangle(mesh, memory);
  EXPECT_GT(report.tangles, report.untangled);
  EXPECT_TRUE(test::defects_of(mesh).none());
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (std::binary_search(report.moved.begin(), report.moved.end(), v)) continue;
    EXPECT_EQ(mesh.positions()[v], before.positions()[v]) << v;
  }
}

TEST(Untangling, MendsMostOfARandomSoupTheSameForAnyNumberOfThreads) {
  std::vector<std::vector<Vec3f>> results;
  for (const std::size_t threads : {1U, 2U, 5U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    TriangleMesh mesh = make_soup(60, 0.15F);
    UpkeepMemory memory;
    untangle(mesh, memory);
    results.push_back(mesh.positions());
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
  TriangleMesh mesh = make_soup(60, 0.15F);
  const std::size_t before = crossing_triangles(mesh);
  ASSERT_GT(before, 20U);
  mesh.positions() = results[0];
  EXPECT_LT(10 * crossing_triangles(mesh), before);
}

}  // namespace
}  // namespace particle_surface_tracker
