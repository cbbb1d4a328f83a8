// The mesh checker against CGAL's Polygon_mesh_processing, and against itself, on random meshes.

#include <random>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "particle_surface_tracker/core/mesh_check.h"
#include "sequences/mesh_judge.h"
#include "sequences/solid_judge.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

/// Three spheres near each other, all of whose vertices are moved at random, on a lattice of `step` if that is not 0:
/// then many triangles are coplanar, and touch in points and edges.
TriangleMesh random_mesh(std::uint32_t seed, double noise, double step) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto number = [&] { return uniform(random); };
  std::vector<TriangleMesh> parts;
  for (int part = 0; part < 3; ++part) {
    const Vec3d center(number(), number(), number());
    parts.push_back(test::make_sphere(center, 0.7 + 0.4 * number(), 3));
  }
  TriangleMesh mesh = test::joined(parts);
  for (Vec3f& position : mesh.positions()) {
    Vec3d moved = position.cast<double>() + noise * Vec3d(number(), number(), number());
    if (step > 0.0) moved = (moved / step).array().round() * step;
    position = moved.cast<float>();
  }
  return mesh;
}

class RandomMeshes : public testing::TestWithParam<std::uint32_t> {};

TEST_P(RandomMeshes, IntersectAsCgalSays) {
  const std::uint32_t seed = GetParam();
  for (const double noise : {0.0, 0.01, 0.1, 0.5}) {
    const TriangleMesh mesh = random_mesh(seed, noise, 0.0);
    const MeshCheck check = check_mesh(mesh.positions(), mesh.triangles());
    ASSERT_EQ(check.flat_triangles.count, 0U);
    EXPECT_EQ(check.self_intersecting_triangles.count,
              test::count_self_intersecting_triangles(mesh.positions(), mesh.triangles()))
        << "seed " << seed << ", noise " << noise;
  }
}

TEST_P(RandomMeshes, OnALatticeIntersectAsCgalSays) {
  const std::uint32_t seed = GetParam();
  for (const double step : {1.0 / 64, 1.0 / 16}) {
    // CGAL's answer on flat triangles is another one, so their vertices are shaken a little.
    TriangleMesh mesh = random_mesh(seed, 0.05, step);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> shake(-1e-3F, 1e-3F);
    for (int round = 0; round < 20; ++round) {
      bool any_flat = false;
      for (const Triangle& t : mesh.triangles()) {
        const MeshCheck alone = check_mesh(mesh.positions(), {t}, {false, false, false});
        if (alone.flat_triangles.count == 0) continue;
        any_flat = true;
        for (const std::uint32_t v : t) mesh.positions()[v] += Vec3f(shake(random), shake(random), shake(random));
      }
      if (!any_flat) break;
    }
    const MeshCheck check = check_mesh(mesh.positions(), mesh.triangles());
    ASSERT_EQ(check.flat_triangles.count, 0U);
    EXPECT_EQ(check.self_intersecting_triangles.count,
              test::count_self_intersecting_triangles(mesh.positions(), mesh.triangles()))
        << "seed " << seed << ", step " << step;
  }
}

TEST_P(RandomMeshes, BrokenAtRandomHaveTheDefectsOfTheIndependentJudge) {
  const std::uint32_t seed = GetParam();
  const TriangleMesh mesh = random_mesh(seed, 0.01, 0.0);
  std::mt19937 random(seed);
  std::vector<Triangle> triangles = mesh.triangles();
  for (int n = 0; n < 12; ++n) {
    Triangle& t = triangles[random() % triangles.size()];
    switch (random() % 4) {
      case 0:
        std::swap(t[0], t[1]);
        break;
      case 1:
        t = triangles.back();
        triangles.pop_back();
        break;
      case 2:
        t[random() % 3] = static_cast<std::uint32_t>(random() % mesh.vertex_count());
        break;
      default:
        triangles.push_back(t);
    }
  }
  const MeshDefects found = find_mesh_defects(mesh.positions(), triangles);
  const test::SurfaceDefects judged = test::find_surface_defects(mesh.vertex_count(), triangles);
  ASSERT_EQ(judged.degenerate_triangles, 0U) << "seed " << seed;
  EXPECT_EQ(found.open_edges.count, judged.open_edges) << "seed " << seed;
  EXPECT_EQ(found.non_manifold_edges.count, judged.non_manifold_edges) << "seed " << seed;
  EXPECT_EQ(found.flipped_edges.count, judged.flipped_edges) << "seed " << seed;
  EXPECT_EQ(found.unused_vertices.count, judged.unused_vertices) << "seed " << seed;
  // The judge also counts vertices at bad edges.
  EXPECT_LE(found.non_manifold_vertices.count, judged.non_manifold_vertices) << "seed " << seed;
}

TEST_P(RandomMeshes, GiveTheSameForAnyNumberOfThreads) {
  const TriangleMesh mesh = random_mesh(GetParam(), 0.2, 0.0);
  const auto checked_with = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return check_mesh(mesh.positions(), mesh.triangles());
  };
  const MeshCheck one = checked_with(1);
  const MeshCheck two = checked_with(2);
  for (std::size_t k = 0; k < list_defects(one).size(); ++k) {
    const MeshDefect& first = *list_defects(one)[k].defect;
    const MeshDefect& second = *list_defects(two)[k].defect;
    ASSERT_EQ(first.count, second.count);
    for (std::size_t n = 0; n < first.places.size(); ++n) {
      EXPECT_EQ(first.places[n].index, second.places[n].index);
      EXPECT_EQ(first.places[n].other, second.places[n].other);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomMeshes, testing::Range(1U, 9U));

/// Shells around random centres, each solid or cavity, some inside others: the winding number around a shell is that of
/// the other shells at any of its vertices.
TEST(Nesting, OfRandomShellsAgreesWithTheIndependentJudge) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    // Shells of one centre have radii more than 0.1 apart, centres are far from each other: nothing crosses.
    std::vector<TriangleMesh> shells;
    for (int center = 0; center < 3; ++center) {
      for (int shell = 0; shell < 4; ++shell) {
        if (uniform(random) < 0.3) continue;
        const TriangleMesh ball = test::make_sphere({3.0 * center, 0, 0}, 0.2 + 0.25 * shell, 3);
        shells.push_back(uniform(random) < 0.5 ? ball : test::turned(ball));
      }
    }
    std::shuffle(shells.begin(), shells.end(), random);
    const TriangleMesh mesh = test::joined(shells);
    const MeshCheck check = check_mesh(mesh.positions(), mesh.triangles());
    ASSERT_EQ(check.components.size(), shells.size()) << "seed " << seed;
    EXPECT_EQ(check.self_intersecting_triangles.count, 0U) << "seed " << seed;
    for (std::size_t c = 0; c < shells.size(); ++c) {
      int around = 0;
      for (std::size_t other = 0; other < shells.size(); ++other) {
        if (other == c) continue;
        const test::SolidJudge judge(shells[other].positions(), shells[other].triangles());
        around += judge.winding_number(shells[c].positions()[0]);
      }
      EXPECT_EQ(check.components[c].winding_around, around) << "seed " << seed << ", shell " << c;
    }
  }
}

}  // namespace
}  // namespace particle_surface_tracker
