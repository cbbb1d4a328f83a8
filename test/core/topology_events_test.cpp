#include "particle_surface_tracker/core/topology_events.h"

#include <gtest/gtest.h>

namespace particle_surface_tracker::test {
namespace {

using Kind = TopologyEvent::Kind;

/// A mesh put together by hand: every piece a tetrahedron, or several joined by a triangle, with ids of its own.
class Pieces {
 public:
  /// \param first_id the vertices have this id and the three that follow.
  Pieces& add(std::uint32_t first_id, float x) {
    const auto f = static_cast<std::uint32_t>(ids_.size());
    for (std::uint32_t n = 0; n < 4; ++n) ids_.push_back(first_id + n);
    for (const float offset : {0.0f, 0.1f, 0.0f, 0.0f}) positions_.emplace_back(x + offset, 0.0f, 0.0f);
    triangles_.insert(triangles_.end(),
                      {{f, f + 2, f + 1}, {f, f + 1, f + 3}, {f, f + 3, f + 2}, {f + 1, f + 2, f + 3}});
    return *this;
  }

  /// Joins the last two pieces by a triangle.
  Pieces& join() {
    const auto count = static_cast<std::uint32_t>(ids_.size());
    triangles_.push_back({count - 1, count - 5, count - 2});
    return *this;
  }

  IdentifiedMesh mesh() const {
    components_ = vertex_components(ids_.size(), triangles_);
    return {ids_, positions_, components_};
  }

 private:
  std::vector<std::uint32_t> ids_;
  std::vector<Vec3f> positions_;
  std::vector<Triangle> triangles_;
  mutable VertexComponents components_;
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
  EXPECT_EQ(find_topology_events(before.mesh(), Pieces().mesh(), 10.0).size(), 2u);
  EXPECT_TRUE(find_topology_events(Pieces().mesh(), Pieces().mesh(), 10.0).empty());
}

}  // namespace
}  // namespace particle_surface_tracker::test
