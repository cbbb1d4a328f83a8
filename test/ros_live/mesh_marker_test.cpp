#include "ros/live/mesh_marker.h"

#include <gtest/gtest.h>

namespace particle_surface_tracker {
namespace {

using visualization_msgs::Marker;

TrackedMesh square() {
  TrackedMesh mesh;
  mesh.header.frame_id = "tank";
  mesh.header.stamp = ros::Time(5, 7);
  mesh.vertices = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0.5f};
  mesh.triangles = {0, 1, 2, 0, 2, 3};
  mesh.colors = {1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 0.5f, 0, 0, 0, 1};
  return mesh;
}

TEST(MeshMarker, HasThreePointsPerTriangle) {
  const auto marker = make_marker(square(), /*with_colors*/ false);
  EXPECT_EQ(marker->header.frame_id, "tank");
  EXPECT_EQ(marker->header.stamp, ros::Time(5, 7));
  EXPECT_EQ(marker->type, Marker::TRIANGLE_LIST);
  EXPECT_EQ(marker->action, Marker::ADD);
  EXPECT_EQ(marker->pose.orientation.w, 1.0);
  EXPECT_EQ(marker->scale.x, 1.0);
  EXPECT_GT(marker->color.a, 0.0f);
  ASSERT_EQ(marker->points.size(), 6u);
  EXPECT_EQ(marker->points[2].y, 1.0);
  EXPECT_EQ(marker->points[5].z, 0.5);
  EXPECT_TRUE(marker->colors.empty());
}

TEST(MeshMarker, TakesColoursWhereThereAreAny) {
  TrackedMesh mesh = square();
  const auto colored = make_marker(mesh, /*with_colors*/ true);
  ASSERT_EQ(colored->colors.size(), 6u);
  EXPECT_EQ(colored->colors[2].b, 1.0f);
  EXPECT_EQ(colored->colors[2].a, 0.5f);
  mesh.colors.clear();
  EXPECT_TRUE(make_marker(mesh, /*with_colors*/ true)->colors.empty());
}

TEST(MeshMarker, RemovalNamesTheSameMarker) {
  const auto marker = make_marker(square(), false);
  const auto removal = make_marker_removal(square().header);
  EXPECT_EQ(removal->action, Marker::DELETE);
  EXPECT_EQ(removal->ns, marker->ns);
  EXPECT_EQ(removal->id, marker->id);
  EXPECT_TRUE(removal->points.empty());
}

}  // namespace
}  // namespace particle_surface_tracker
