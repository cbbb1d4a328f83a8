#include <random>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "particle_surface_tracker/stages/upkeep.h"
#include "support/shapes.h"
#include "upkeep_support.h"

namespace particle_surface_tracker {
namespace {

/// A sphere and a torus with every vertex moved by up to `amount` of its edges' length, at random.
TriangleMesh make_soup(std::uint32_t seed, double amount) {
  TriangleMesh mesh =
      test::joined({test::make_sphere({0, 0, 0}, 0.6, 5), test::make_torus({0.9, 0.1, 0.2}, 0.5, 0.16, 96, 32)});
  note_birth(mesh);
  std::mt19937 random(seed);
  const double edge = 0.033;
  test::move_vertices(mesh, [&](const Vec3d& x) {
    Vec3d shift;
    for (double& s : shift) s = static_cast<double>(random()) / 2147483648.0 - 1.0;
    return Vec3d(x + amount * edge * shift);
  });
  return mesh;
}

TEST(UpkeepSoup, MendsRandomSoupsAndThenLeavesThemAlone) {
  const Parameters parameters = test::parameters_for_cells_of(0.05);
  UpkeepMemory shared;
  for (const std::uint32_t seed : {1U, 2U}) {
    for (const double amount : {0.3, 1.0}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", moved by up to " << amount << " edges");
      TriangleMesh mesh = make_soup(seed, amount);
      TriangleMesh same = mesh;
      const UpkeepReport report = keep_up(mesh, parameters, shared);
      EXPECT_TRUE(report.has_changes());
      EXPECT_TRUE(test::defects_of(mesh).none());
      for (const Triangle& t : mesh.triangles()) {
        for (std::size_t k = 0; k < 3; ++k) ASSERT_NE(mesh.positions()[t[k]], mesh.positions()[t[(k + 1) % 3]]);
      }
      keep_up(same, parameters);
      test::expect_same_bits(mesh, same);

      const TriangleMesh before = mesh;
      EXPECT_FALSE(keep_up(mesh, parameters).has_changes());
      test::expect_same_bits(mesh, before);
    }
  }
}

TEST(UpkeepSoup, GivesTheSameBytesForAnyNumberOfThreads) {
  const Parameters parameters = test::parameters_for_cells_of(0.05);
  std::vector<TriangleMesh> meshes;
  for (const std::size_t threads : {1U, 2U, 5U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    meshes.push_back(make_soup(7, 1.0));
    keep_up(meshes.back(), parameters);
  }
  test::expect_same_bits(meshes[1], meshes[0]);
  test::expect_same_bits(meshes[2], meshes[0]);
}

}  // namespace
}  // namespace particle_surface_tracker
