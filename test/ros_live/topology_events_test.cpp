#include "ros/live/topology_events.h"

#include <gtest/gtest.h>
#include <boost/make_shared.hpp>

#include "ros/live/topology_markers.h"

namespace particle_surface_tracker::test {
namespace {

using Kind = TopologyEvent::Kind;

/// A mesh put together by hand: every piece a tetrahedron, or several joined by a triangle, with ids of its own.
class Pieces {
 public:
  /// \param first_id the vertices have this id and the three that follow.
  Pieces& add(std::uint32_t first_id, float x) {
    const auto first = static_cast<std::uint32_t>(mesh_.ids.size());
    for (std::uint32_t n = 0; n < 4; ++n) mesh_.ids.push_back(first_id + n);
    for (const float offset : {0.0f, 0.1f, 0.0f, 0.0f}) {
      mesh_.vertices.insert(mesh_.vertices.end(), {x + offset, 0.0f, 0.0f});
    }
    for (const std::uint32_t corner : {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}) mesh_.triangles.push_back(first + corner);
    return *this;
  }

  /// Joins the last two pieces by a triangle.
  Pieces& join() {
    const auto count = static_cast<std::uint32_t>(mesh_.ids.size());
    mesh_.triangles.insert(mesh_.triangles.end(), {count - 1, count - 5, count - 2});
    return *this;
  }

  const TrackedMesh& mesh() const { return mesh_; }

 private:
  TrackedMesh mesh_;
};

constexpr double kReach = 0.5;

TEST(TopologyEvents, NothingHappensToPiecesThatStay) {
  const Pieces two = Pieces().add(0, 0.0f).add(4, 5.0f);
  EXPECT_TRUE(find_topology_events(two.mesh(), two.mesh(), kReach).empty());
}

TEST(TopologyEvents, PiecesThatComeApartAreASplit) {
  const Pieces before = Pieces().add(0, 0.0f).add(4, 5.0f).join();
  const Pieces after = Pieces().add(0, 0.0f).add(4, 5.0f);
  const auto events = find_topology_events(before.mesh(), after.mesh(), kReach);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, Kind::kSplit);
  const auto back = find_topology_events(after.mesh(), before.mesh(), kReach);
  ASSERT_EQ(back.size(), 1u);
  EXPECT_EQ(back[0].kind, Kind::kMerge);
}

TEST(TopologyEvents, APieceOfNewVerticesHasSplitOffTheNearest) {
  const Pieces before = Pieces().add(0, 0.0f).add(4, 5.0f);
  const Pieces after = Pieces().add(0, 0.0f).add(4, 5.0f).add(8, 6.0f);
  const auto events = find_topology_events(before.mesh(), after.mesh(), kReach);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, Kind::kSplit);
  // It is new vertices that tell where the cut is.
  EXPECT_NEAR(events[0].place.x(), 6.0f, 0.11f);
}

TEST(TopologyEvents, APieceThatIsNoMoreHasGoneOrJoinedWhatIsNear) {
  const Pieces before = Pieces().add(0, 0.0f).add(4, 5.0f);
  const Pieces after = Pieces().add(0, 0.0f);
  const auto gone = find_topology_events(before.mesh(), after.mesh(), kReach);
  ASSERT_EQ(gone.size(), 1u);
  EXPECT_EQ(gone[0].kind, Kind::kGone);
  EXPECT_NEAR(gone[0].place.x(), 5.0f, 0.11f);
  const auto joined = find_topology_events(before.mesh(), after.mesh(), 10.0);
  ASSERT_EQ(joined.size(), 1u);
  EXPECT_EQ(joined[0].kind, Kind::kMerge);
  // An empty mesh has nothing that could be joined.
  EXPECT_EQ(find_topology_events(before.mesh(), TrackedMesh(), 10.0).size(), 2u);
  EXPECT_TRUE(find_topology_events(TrackedMesh(), TrackedMesh(), 10.0).empty());
}

TrackedView view() {
  TrackedView view;
  view.mesh = boost::make_shared<const TrackedMesh>(Pieces().add(0, 0.0f).mesh());
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
