#include "ros/live/topology_markers.h"

#include <gtest/gtest.h>
#include <boost/make_shared.hpp>

namespace particle_surface_tracker::test {
namespace {

using Kind = TopologyEvent::Kind;

TrackedView view() {
  TrackedView view;
  view.mesh = boost::make_shared<const TrackedMesh>();
  view.r = 0.1;
  view.cell_size = 0.05;
  return view;
}

TEST(TopologyMarkers, KeepCellsAndEventsUntilTheyAreShown) {
  using visualization_msgs::Marker;
  TopologyMarkers markers;
  TrackedView first = view();
  first.remeshed_cells = {openvdb::Coord(-1, 0, 2)};
  first.events = {{Kind::kSplit, Vec3f(1, 2, 3)}};
  markers.remember(first);
  TrackedView second = view();
  second.flagged_cells = {openvdb::Coord(4, 4, 4)};
  second.remeshed_cells = {openvdb::Coord(-1, 0, 2), openvdb::Coord(0, 0, 0)};
  second.events = {{Kind::kMerge, Vec3f(4, 5, 6)}};
  markers.remember(second);
  const auto shown = markers.show(second);
  ASSERT_EQ(shown->markers.size(), 4u);
  EXPECT_EQ(shown->markers[0].type, Marker::CUBE_LIST);
  EXPECT_EQ(shown->markers[0].points.size(), 1u);
  EXPECT_EQ(shown->markers[0].scale.x, 0.05);
  ASSERT_EQ(shown->markers[1].points.size(), 2u);
  EXPECT_NEAR(shown->markers[1].points[0].x, -0.025, 1e-12);
  EXPECT_NEAR(shown->markers[1].points[0].z, 0.125, 1e-12);
  EXPECT_EQ(shown->markers[2].text, "split");
  EXPECT_EQ(shown->markers[2].pose.position.y, 2.0);
  EXPECT_EQ(shown->markers[3].text, "merge");
  EXPECT_NE(shown->markers[2].id, shown->markers[3].id);
  EXPECT_GT(shown->markers[3].lifetime.toSec(), 0.0);
  // Then they are done with.
  const auto next = markers.show(view());
  ASSERT_EQ(next->markers.size(), 2u);
  EXPECT_EQ(next->markers[1].action, Marker::DELETE);
  EXPECT_EQ(markers.remove({})->markers.at(0).action, Marker::DELETEALL);
}

TEST(TopologyMarkers, ShowTheCellsOfEachKindWhereTheyWereRecorded) {
  TopologyCells cells;
  cells.complex = {{0, 0, 0}, {1, 0, 0}};
  cells.tangled = {{1, 0, 0}};
  cells.front = {{2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
  TrackedView recorded = view();
  recorded.cells = std::make_shared<const TopologyCells>(cells);
  const auto shown = TopologyMarkers().show(recorded);
  ASSERT_EQ(shown->markers.size(), 6u);
  EXPECT_EQ(shown->markers[2].ns, "complex_cells");
  EXPECT_EQ(shown->markers[2].points.size(), 2u);
  EXPECT_EQ(shown->markers[3].ns, "tangled_cells");
  EXPECT_EQ(shown->markers[3].points.size(), 1u);
  EXPECT_EQ(shown->markers[4].ns, "deep_cells");
  EXPECT_EQ(shown->markers[4].action, visualization_msgs::Marker::DELETE);
  EXPECT_EQ(shown->markers[5].ns, "front_cells");
  EXPECT_EQ(shown->markers[5].points.size(), 3u);
}

}  // namespace
}  // namespace particle_surface_tracker::test
