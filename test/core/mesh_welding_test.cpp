#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh_check_support.h"

namespace particle_surface_tracker {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

TEST(Weld, DoubledVerticesBecomeOne) {
  // A box as STL has it: every triangle with corners of its own, one of them with −0.
  const TriangleMesh shape = test::unit_box();
  std::vector<Vec3f> positions;
  test::Triangles triangles;
  for (const Triangle& t : shape.triangles()) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (const std::uint32_t v : t) positions.push_back(shape.positions()[v]);
    triangles.push_back({first, first + 1, first + 2});
  }
  for (float& value : positions[17]) value = value == 0.0F ? -0.0F : value;
  const TriangleMesh soup(positions, triangles);
  EXPECT_EQ(test::check_of(soup).defects.open_edges.count, 36U);
  const WeldedTriangles welded = weld_by_position(positions, triangles);
  EXPECT_EQ(welded.merged_vertices, 36U - 8U);
  EXPECT_TRUE(test::welded_check_of(soup).is_sound());
  EXPECT_NEAR(test::welded_check_of(soup).volume(), 1.0, 1e-12);
}

TEST(Weld, TwoBoxesAtACornerBecomeNonManifold) {
  const TriangleMesh boxes = test::joined({test::box(-1, 1), test::box(1, 1)});
  EXPECT_TRUE(test::check_of(boxes).defects.none());
  const MeshCheck welded = test::welded_check_of(boxes);
  EXPECT_THAT(test::counts_of(welded), ElementsAre(Pair("non_manifold_vertices", 1U)));
  EXPECT_EQ(welded.components.size(), 1U);
}

TEST(Weld, AnEdgeWithoutLengthBecomesDegenerate) {
  TriangleMesh sphere = test::make_sphere(Vec3d::Zero(), 1.0, 2);
  const Triangle pinched = sphere.triangles()[7];
  sphere.positions()[pinched[1]] = sphere.positions()[pinched[0]];
  EXPECT_EQ(test::check_of(sphere).flat_triangles.count, 2U);
  EXPECT_TRUE(test::check_of(sphere).defects.none());
  const MeshCheck welded = test::welded_check_of(sphere);
  EXPECT_EQ(welded.defects.degenerate_triangles.count, 2U);
  EXPECT_TRUE(welded.components.at(0).is_manifold);
}

}  // namespace
}  // namespace particle_surface_tracker
