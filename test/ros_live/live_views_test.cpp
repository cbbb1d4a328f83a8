// What the live node shows in rviz, and the particles' fields that it puts onto the mesh.

#include <chrono>
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>
#include <boost/make_shared.hpp>

#include "ros_live/live_node_test.h"

namespace particle_surface_tracker::test {
namespace {

using sensor_msgs::PointCloud2;
using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;
using State = TrackerStatus;

class LiveViews : public LiveNodeTest {};

TEST_F(LiveViews, MarkerComesAtItsRateAndGoesWithTheReset) {
  const auto node = load({{"marker_max_rate", "2"}});
  Collector<Marker> markers(node->name() + "/marker");
  ASSERT_TRUE(markers.wait_for_publisher());
  const auto begin = std::chrono::steady_clock::now();
  for (int n = 0; n < 8; ++n) node->answer(n);
  // The first at once, the last when its time has come, though no more frames arrive.
  auto received = markers.wait_for(2);
  while (received.back()->header.stamp != ball_cloud(7)->header.stamp) {
    const auto more = markers.wait_for(received.size() + 1);
    ASSERT_GT(more.size(), received.size());
    received = more;
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  EXPECT_LE(static_cast<double>(received.size()), 2.0 + 2.0 * elapsed.count());
  EXPECT_LT(received.size(), 8u);
  for (const auto& marker : received) {
    EXPECT_EQ(marker->type, Marker::TRIANGLE_LIST);
    EXPECT_EQ(marker->action, Marker::ADD);
    EXPECT_EQ(marker->ns, received.front()->ns);
    EXPECT_EQ(marker->id, 0);
    EXPECT_EQ(marker->points.size(), 3 * ball_mesh().triangle_count());
  }
  call_reset(*node);
  const std::size_t before = received.size();
  received = markers.wait_for(before + 1);
  ASSERT_GT(received.size(), before);
  EXPECT_EQ(received.back()->action, Marker::DELETE);
  EXPECT_EQ(received.back()->ns, received.front()->ns);
  EXPECT_EQ(received.back()->id, 0);
  EXPECT_EQ(node->answer(0).state, State::STARTED);
}

TEST_F(LiveViews, ImplicitSurfaceAndCellsAreShownAndGoWithTheReset) {
  const auto node = load({{"marker_max_rate", "1000"}});
  Collector<Marker> surfaces(node->name() + "/surface_marker");
  Collector<MarkerArray> topology(node->name() + "/topology_marker");
  ASSERT_TRUE(surfaces.wait_for_publisher());
  ASSERT_TRUE(topology.wait_for_publisher());
  node->answer(0);
  const auto surface = surfaces.wait_for(1);
  const auto cells = topology.wait_for(1);
  ASSERT_EQ(surface.size(), 1u);
  ASSERT_EQ(cells.size(), 1u);
  FrameHandler offline = handler();
  offline.handle(*ball_cloud(0), 0);
  EXPECT_EQ(surface[0]->points.size(), 3 * offline.tracker().implicit_surface()->triangulation.triangles.size());
  EXPECT_LT(surface[0]->color.a, 1.0f);
  ASSERT_EQ(cells[0]->markers.size(), 6u);
  EXPECT_EQ(cells[0]->markers[0].ns, "flagged_cells");
  EXPECT_EQ(cells[0]->markers[1].ns, "remeshed_cells");
  EXPECT_EQ(cells[0]->markers[5].ns, "front_cells");
  call_reset(*node);
  ASSERT_EQ(surfaces.wait_for(2).size(), 2u);
  EXPECT_EQ(surfaces.wait_for(2)[1]->action, Marker::DELETE);
  EXPECT_EQ(surfaces.wait_for(2)[1]->ns, surface[0]->ns);
  ASSERT_EQ(topology.wait_for(2).size(), 2u);
  EXPECT_EQ(topology.wait_for(2)[1]->markers.at(0).action, Marker::DELETEALL);
}

TEST_F(LiveViews, MarkersAreColouredByWhatIsAskedFor) {
  for (const char* wanted : {"delta", "velocity", "id"}) {
    const auto node = load({{"marker_color_by", wanted}, {"marker_max_rate", "1000"}});
    Collector<Marker> markers(node->name() + "/marker");
    ASSERT_TRUE(markers.wait_for_publisher());
    node->answer(0);
    node->answer(1);
    const auto received = markers.wait_for(2);
    ASSERT_EQ(received.size(), 2u) << wanted;
    EXPECT_EQ(received[1]->colors.size(), received[1]->points.size()) << wanted;
  }
  // The ball carries no colours.
  const auto node = load({{"marker_color_by", "carried"}});
  Collector<Marker> markers(node->name() + "/marker");
  ASSERT_TRUE(markers.wait_for_publisher());
  node->answer(0);
  ASSERT_EQ(markers.wait_for(1).size(), 1u);
  EXPECT_TRUE(markers.wait_for(1)[0]->colors.empty());
}

// A cloud of the ball with one more field, the height of each particle.
sensor_msgs::PointCloud2Ptr with_height(int n) {
  const auto plain = ball_cloud(n);
  auto cloud = boost::make_shared<PointCloud2>(*plain);
  sensor_msgs::PointField field = plain->fields.back();
  field.name = "height";
  field.offset = plain->point_step;
  field.datatype = sensor_msgs::PointField::FLOAT32;
  cloud->fields.push_back(field);
  cloud->point_step += 4;
  cloud->row_step = cloud->point_step * cloud->width;
  cloud->data.clear();
  for (std::uint32_t p = 0; p < plain->width; ++p) {
    const std::uint8_t* point = &plain->data[std::size_t{p} * plain->point_step];
    cloud->data.insert(cloud->data.end(), point, point + plain->point_step);
    cloud->data.insert(cloud->data.end(), point + 8, point + 12);  // z
  }
  return cloud;
}

TEST_F(LiveViews, FieldsOfTheParticlesAreInterpolatedOnRequest) {
  const auto node = load({{"interpolate", "height, temperature"}});
  Collector<TrackedMesh> meshes(node->name() + "/mesh");
  ASSERT_TRUE(meshes.wait_for_publisher());
  const State answer = node->answer(with_height(0));
  EXPECT_EQ(answer.state, State::STARTED);
  ASSERT_EQ(answer.warnings.size(), 1u);
  EXPECT_NE(answer.warnings[0].find("'temperature'"), std::string::npos) << answer.warnings[0];
  ASSERT_EQ(meshes.wait_for(1).size(), 1u);
  const TrackedMesh& mesh = *meshes.wait_for(1)[0];
  ASSERT_EQ(mesh.interpolated.size(), 1u);
  EXPECT_EQ(mesh.interpolated[0].name, "height");
  EXPECT_EQ(mesh.interpolated[0].components, 1u);
  ASSERT_EQ(mesh.interpolated[0].values.size(), mesh.ids.size());
  for (std::size_t v = 0; v < mesh.ids.size(); ++v) {
    // The particles around a vertex of the surface lie below it.
    EXPECT_NEAR(mesh.interpolated[0].values[v], mesh.vertices[3 * v + 2], 1.5 * kBallSpacing) << v;
  }
}

}  // namespace
}  // namespace particle_surface_tracker::test
