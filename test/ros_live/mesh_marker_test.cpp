#include "ros/live/mesh_marker.h"

#include <utility>

#include <gtest/gtest.h>
#include <boost/make_shared.hpp>

namespace particle_surface_tracker {
namespace {

using visualization_msgs::Marker;

TrackedMesh square() {
  TrackedMesh mesh;
  mesh.header.frame_id = "tank";
  mesh.header.stamp = ros::Time(5, 7);
  mesh.vertices = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0.5f};
  mesh.triangles = {0, 1, 2, 0, 2, 3};
  mesh.ids = {3, 4, 5, 9};
  mesh.delta = {0.0f, 0.05f, -0.05f, -1.0f};
  mesh.velocities = {0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, -4};
  mesh.colors = {1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 1, 0.5f, 0, 0, 0, 1};
  return mesh;
}

TrackedView view_of(const TrackedMesh& mesh) {
  TrackedView view;
  view.mesh = boost::make_shared<const TrackedMesh>(mesh);
  view.r = 0.1;
  view.cell_size = 0.05;
  return view;
}

TEST(MeshMarker, HasThreePointsPerTriangle) {
  const auto marker = make_mesh_marker(view_of(square()), MarkerColoring::kNone);
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

TEST(MeshMarker, TakesCarriedColoursWhereThereAreAny) {
  TrackedMesh mesh = square();
  const auto colored = make_mesh_marker(view_of(mesh), MarkerColoring::kCarried);
  ASSERT_EQ(colored->colors.size(), 6u);
  EXPECT_EQ(colored->colors[2].b, 1.0f);
  EXPECT_EQ(colored->colors[2].a, 0.5f);
  mesh.colors.clear();
  EXPECT_TRUE(make_mesh_marker(view_of(mesh), MarkerColoring::kCarried)->colors.empty());
}

TEST(MeshMarker, ColoursByDeltaTellInsideFromOutside) {
  const auto colors = vertex_colors(view_of(square()), MarkerColoring::kDelta);
  ASSERT_EQ(colors.size(), 4u);
  EXPECT_EQ(colors[0].r, colors[0].b);
  EXPECT_GT(colors[1].r, colors[1].b);
  EXPECT_LT(colors[2].r, colors[2].b);
  // ±r / 2 is the end of the scale.
  EXPECT_EQ(colors[2], colors[3]);
}

TEST(MeshMarker, ColoursByVelocityGrowWithTheSpeed) {
  TrackedMesh mesh = square();
  const auto colors = vertex_colors(view_of(mesh), MarkerColoring::kVelocity);
  ASSERT_EQ(colors.size(), 4u);
  for (std::size_t v = 1; v < 4; ++v) EXPECT_GT(colors[v].r, colors[v - 1].r) << v;
  mesh.velocities.clear();
  EXPECT_TRUE(vertex_colors(view_of(mesh), MarkerColoring::kVelocity).empty());
}

TEST(MeshMarker, ColoursByIdBelongToTheId) {
  TrackedMesh mesh = square();
  const auto colors = vertex_colors(view_of(mesh), MarkerColoring::kId);
  ASSERT_EQ(colors.size(), 4u);
  EXPECT_NE(colors[0], colors[1]);
  std::swap(mesh.ids[0], mesh.ids[1]);
  EXPECT_EQ(vertex_colors(view_of(mesh), MarkerColoring::kId)[1], colors[0]);
}

TEST(SurfaceMarker, ShowsTheImplicitSurfaceThroughTheMesh) {
  auto surface = std::make_shared<ImplicitSurface>();
  surface->triangulation.vertices = {Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 2, 0)};
  surface->triangulation.triangles = {{0, 1, 2}};
  TrackedView view = view_of(square());
  EXPECT_EQ(make_surface_marker(view)->action, Marker::DELETE);
  view.surface = surface;
  const auto marker = make_surface_marker(view);
  EXPECT_EQ(marker->action, Marker::ADD);
  ASSERT_EQ(marker->points.size(), 3u);
  EXPECT_EQ(marker->points[2].y, 2.0);
  EXPECT_LT(marker->color.a, 1.0f);
  EXPECT_EQ(make_surface_marker_removal(view.mesh->header)->ns, marker->ns);
}

TEST(MeshMarker, RemovalNamesTheSameMarker) {
  const auto marker = make_mesh_marker(view_of(square()), MarkerColoring::kNone);
  const auto removal = make_mesh_marker_removal(square().header);
  EXPECT_EQ(removal->action, Marker::DELETE);
  EXPECT_EQ(removal->ns, marker->ns);
  EXPECT_EQ(removal->id, marker->id);
  EXPECT_TRUE(removal->points.empty());
}

}  // namespace
}  // namespace particle_surface_tracker
