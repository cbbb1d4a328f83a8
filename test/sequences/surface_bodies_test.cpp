#include "sequences/surface_bodies.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/shapes.h"

namespace particle_surface_tracker::test {

namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TriangleMesh cube(double center, double half_side) {
  return make_box(Vec3d::Constant(center - half_side), Vec3d::Constant(center + half_side));
}

SurfaceBodies bodies_in(const std::vector<TriangleMesh>& parts) {
  const TriangleMesh mesh = joined(parts);
  return SurfaceBodies(mesh.positions(), mesh.triangles());
}

}  // namespace

TEST(SurfaceBodies, ADropletInACavityIsABodyOfItsOwn) {
  // A hollow cube, a droplet in its cavity that is hollow itself, and a cube apart.
  const SurfaceBodies bodies = bodies_in({turned(cube(0, 3)), cube(0, 4), cube(0, 2), turned(cube(0, 1)), cube(20, 1)});
  EXPECT_EQ(bodies.size(), 3u);
  EXPECT_EQ(bodies.cavities(), 2u);
  EXPECT_EQ(bodies.nested_solids() + bodies.misplaced_cavities(), 0u);
  EXPECT_THAT(bodies.bodies_of({3.5f, 0, 0}, 0.0), ElementsAre(0u));
  EXPECT_THAT(bodies.bodies_of({1.5f, 0, 0}, 0.0), ElementsAre(1u));
  EXPECT_THAT(bodies.bodies_of({20, 20, 20}, 0.0), ElementsAre(2u));
  EXPECT_THAT(bodies.bodies_of({2.5f, 0, 0}, 0.0), IsEmpty());
  EXPECT_THAT(bodies.bodies_of({0, 0, 0}, 0.0), IsEmpty());
  EXPECT_EQ(bodies.vertex_of(2), Vec3f(19, 19, 19));
}

TEST(SurfaceBodies, APointOutsideBelongsToTheNearestWithinReach) {
  const SurfaceBodies bodies = bodies_in({cube(0, 4), turned(cube(0, 2)), cube(10, 1)});
  EXPECT_THAT(bodies.bodies_of({4.5f, 0, 0}, 0.4), IsEmpty());
  EXPECT_THAT(bodies.bodies_of({4.5f, 0, 0}, 0.6), ElementsAre(0u));
  // In the cavity, near its wall.
  EXPECT_THAT(bodies.bodies_of({1.5f, 0, 0}, 0.6), ElementsAre(0u));
  EXPECT_THAT(bodies.bodies_of({10, 10, 8.5f}, 0.6), ElementsAre(1u));
}

TEST(SurfaceBodies, WhereBodiesOverlapAPointIsInBoth) {
  const SurfaceBodies bodies = bodies_in({cube(0, 2), cube(3, 2)});
  EXPECT_THAT(bodies.bodies_of({1.5f, 1.5f, 1.5f}, 0.0), ElementsAre(0u, 1u));
  EXPECT_THAT(bodies.bodies_of({0, 0, 0}, 0.0), ElementsAre(0u));
  EXPECT_EQ(bodies.nested_solids(), 0u);
}

TEST(SurfaceBodies, CountsWhatIsNestedAsNoLiquidCanBe) {
  EXPECT_EQ(bodies_in({cube(0, 4), cube(0, 2)}).nested_solids(), 1u);
  EXPECT_EQ(bodies_in({turned(cube(0, 2))}).misplaced_cavities(), 1u);
  EXPECT_EQ(bodies_in({cube(0, 4), turned(cube(0, 3)), turned(cube(0, 1))}).misplaced_cavities(), 1u);
  EXPECT_EQ(bodies_in({cube(0, 4), cube(0, 3), turned(cube(0, 1))}).misplaced_cavities(), 1u);
}

TEST(SurfaceBodies, NothingHasNoBodies) {
  const SurfaceBodies nothing({}, {});
  EXPECT_EQ(nothing.size(), 0u);
  EXPECT_THAT(nothing.bodies_of({0, 0, 0}, 100.0), IsEmpty());
}

}  // namespace particle_surface_tracker::test
