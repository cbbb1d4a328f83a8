#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh_check_support.h"

namespace particle_surface_tracker {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

TEST(CheckMeshNesting, SoundNesting) {
  // A hollow ball with a drop in its cavity, that is hollow itself; a box in the hole of a torus.
  const TriangleMesh ball =
      test::joined({test::turned(test::box(0, 3)), test::box(0, 4), test::box(0, 2), test::turned(test::box(0, 1))});
  const MeshCheck check = test::check_of(ball);
  EXPECT_THAT(test::counts_of(check), ElementsAre());
  EXPECT_EQ(check.components[0].winding_around, 1);
  EXPECT_EQ(check.components[1].winding_around, 0);
  EXPECT_EQ(check.components[2].winding_around, 0);
  EXPECT_EQ(check.components[3].winding_around, 1);
  EXPECT_NEAR(check.volume(), 512.0 - 216.0 + 64.0 - 8.0, 1e-9);
  const TriangleMesh torus = test::make_torus(Vec3d::Zero(), 1.0, 0.3, 40, 20);
  EXPECT_TRUE(test::check_of(test::joined({torus, test::box(0, 0.2)})).is_sound());
}

TEST(CheckMeshNesting, SolidInASolid) {
  const MeshCheck check = test::check_of(test::joined({test::box(0, 4), test::box(0, 2), test::box(20, 1)}));
  EXPECT_THAT(test::counts_of(check), ElementsAre(Pair("solids_in_solids", 1U)));
  EXPECT_EQ(check.solids_in_solids.places.at(0).index, 1U);
  EXPECT_EQ(check.solids_in_solids.places.at(0).position, Vec3f(-2, -2, -2));
}

TEST(CheckMeshNesting, InsideOutComponents) {
  EXPECT_THAT(test::counts_of(test::check_of(test::turned(test::unit_box()))),
              ElementsAre(Pair("inside_out_components", 1U)));
  // A cavity in a cavity is in no liquid.
  const TriangleMesh cavities =
      test::joined({test::box(0, 4), test::turned(test::box(0, 3)), test::turned(test::box(0, 1))});
  const MeshCheck check = test::check_of(cavities);
  EXPECT_THAT(test::counts_of(check), ElementsAre(Pair("inside_out_components", 1U)));
  EXPECT_EQ(check.inside_out_components.places.at(0).index, 2U);
}

TEST(CheckMeshNesting, CavityInTwoSolids) {
  const TriangleMesh mesh = test::joined({test::box(0, 4), test::box(0, 3), test::turned(test::box(0, 1))});
  EXPECT_THAT(test::counts_of(test::check_of(mesh)),
              UnorderedElementsAre(Pair("solids_in_solids", 1U), Pair("cavities_in_overlaps", 1U)));
}

TEST(CheckMeshNesting, CrossingSolidsAreNotNested) {
  const TriangleMesh mesh =
      test::joined({test::make_sphere({0, 0, 0}, 1.0, 3), test::make_sphere({1.3, 0, 0}, 1.0, 3)});
  const MeshCheck check = test::check_of(mesh);
  EXPECT_GT(check.self_intersecting_triangles.count, 0U);
  EXPECT_EQ(test::counts_of(check).size(), 1U);
}

TEST(CheckMeshNesting, AnOpenComponentContainsNothing) {
  test::Triangles shell = test::box(0, 4).triangles();
  shell.pop_back();
  const TriangleMesh mesh = test::joined({TriangleMesh(test::box(0, 4).positions(), shell), test::box(0, 1)});
  EXPECT_THAT(test::counts_of(test::check_of(mesh)), ElementsAre(Pair("open_edges", 3U)));
}

}  // namespace
}  // namespace particle_surface_tracker
