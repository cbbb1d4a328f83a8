#include <algorithm>
#include <iterator>
#include <memory>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/mesh_measures.h"
#include "particle_surface_tracker/tracker/tracker.h"
#include "support/parameters.h"
#include "support/shapes.h"
#include "tracker_cases.h"

namespace particle_surface_tracker {
namespace {

using test::r;

/// One around the origin, one around x = 2.
ParticleFrame two_drops() {
  return test::fill_with_particles(Vec3d(-0.6, -0.6, -0.6), Vec3d(2.6, 0.6, 0.6), r, 0.1, 4, [](const Vec3d& x) {
    return std::min(x.norm(), (x - Vec3d(2, 0, 0)).norm()) < 0.5;
  });
}

/// The particles of the first drop.
ParticleFrame first_of(const ParticleFrame& both) {
  ParticleFrame one;
  for (std::size_t i = 0; i < both.size(); ++i) {
    if (both.positions[i].x() > 1.0F) continue;
    one.positions.push_back(both.positions[i]);
    one.ids.push_back(both.ids[i]);
  }
  return one;
}

TEST(TrackerTopology, FlagsVerticesWhoseLiquidHasGone) {
  // A second drop vanishes.
  const ParticleFrame both = two_drops();
  const ParticleFrame one = first_of(both);
  // Where topology is kept, its mesh is left behind, flagged, and does not jump over to the first.
  Parameters keep = test::parameters_with_spacing(r);
  keep.topology = TopologyMode::kKeep;
  Tracker tracker(keep);
  tracker.start_from_particles(both);
  const std::vector<Vec3f> before = tracker.mesh().positions();
  const FrameReport report = tracker.advance(one, 1);
  const auto left_behind = static_cast<std::size_t>(
      std::count_if(before.begin(), before.end(), [](const Vec3f& p) { return p.x() > 1.0f; }));
  EXPECT_EQ(report.flagged_vertices, left_behind);
  EXPECT_EQ(report.unreached_vertices, left_behind);
  EXPECT_GT(report.flagged_cells, 0u);
  EXPECT_EQ(tracker.mesh().positions(), before);

  // Else it goes with its liquid, and the first drop keeps every bit.
  Tracker matching(test::parameters_with_spacing(r));
  matching.start_from_particles(both);
  matching.advance(one, 1);
  std::vector<Vec3f> first_drop;
  std::copy_if(before.begin(), before.end(), std::back_inserter(first_drop),
               [](const Vec3f& p) { return p.x() < 1.0f; });
  EXPECT_EQ(matching.mesh().positions(), first_drop);
}

/// Volume of the bodies with x above a limit.
double volume_beyond(float limit, const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles) {
  std::vector<Triangle> beyond;
  std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(beyond),
               [&](const Triangle& t) { return positions[t[0]].x() > limit; });
  return measure_mesh(positions, beyond).volume;
}

TEST(TrackerTopology, WhatIsAllNewHasNoDetail) {
  // A drop with a layer of detail around it; a second one comes out of nothing.
  const ParticleFrame both = two_drops();
  const ParticleFrame one = first_of(both);
  Tracker tracker(test::parameters_with_spacing(r));
  const TriangleMesh mesh = test::make_sphere(Vec3d::Zero(), 0.5 + 0.8 * r, 4);
  tracker.start(mesh, one);
  const std::vector<float> delta = tracker.mesh().delta();
  EXPECT_GT(*std::min_element(delta.begin(), delta.end()), 0.0F);
  tracker.advance(both, 1);
  std::size_t made = 0;
  for (std::uint32_t v = 0; v < tracker.mesh().vertex_count(); ++v) {
    const std::uint32_t id = tracker.mesh().ids()[v];
    if (id >= mesh.vertex_count()) ++made;
    EXPECT_EQ(tracker.mesh().delta()[v], id < mesh.vertex_count() ? delta[id] : 0.0F);
  }
  EXPECT_GT(made, 100U);
  // So it is drawn onto φ = 0, wherever filling and smoothing have put it.
  tracker.advance(both, 2);
  const SurfaceTriangulation& isosurface = tracker.implicit_surface()->triangulation;
  const double expected = volume_beyond(1.0F, isosurface.vertices, isosurface.triangles);
  EXPECT_NEAR(volume_beyond(1.0F, tracker.mesh().positions(), tracker.mesh().triangles()), expected, 2e-3 * expected);
}

TEST(TrackerTopology, RecordsTheCellsOfAMergeAndTracksAsWithout) {
  const TriangleMesh mesh =
      test::joined({test::make_sphere({-0.56, 0.01, 0.02}, 0.5, 4), test::make_sphere({0.56, -0.02, 0.01}, 0.5, 4)});
  const ParticleFrame drops =
      test::fill_with_particles({-1.2, -0.6, -0.6}, {1.2, 0.6, 0.6}, r, 0.1, 3, [](const Vec3d& x) {
        return std::min((x - Vec3d(-0.56, 0.01, 0.02)).norm(), (x - Vec3d(0.56, -0.02, 0.01)).norm()) < 0.5 - 0.1 * r;
      });
  Tracker tracker(test::parameters_with_spacing(r));
  Tracker other(test::parameters_with_spacing(r));
  tracker.start(mesh, drops);
  other.start(mesh, drops);
  EXPECT_EQ(tracker.topology_cells(), nullptr);
  tracker.record_topology_cells(true);
  std::size_t marked = 0;
  for (int n = 1; n <= 8; ++n) {
    const ParticleFrame frame = test::moved(
        drops, [n](const Vec3d& x) { return Vec3d(x - Vec3d(x.x() > 0.0 ? 0.02 * n : -0.02 * n, 0.0, 0.0)); });
    const FrameReport report = tracker.advance(frame, n);
    other.advance(frame, n);
    ASSERT_EQ(tracker.mesh().positions(), other.mesh().positions());
    ASSERT_EQ(tracker.mesh().triangles(), other.mesh().triangles());
    const std::shared_ptr<const TopologyCells> cells = tracker.topology_cells();
    ASSERT_NE(cells, nullptr);
    EXPECT_EQ(cells->cell_size, 0.5 * r);
    if (report.topology.passes == 1) {
      EXPECT_EQ(cells->marked.size(), report.topology.remeshed_cells);
      EXPECT_EQ(cells->unknown.nodes.size(), report.topology.unknowns);
      EXPECT_EQ(cells->changed_nodes.size(), report.topology.changed_nodes);
    }
    EXPECT_TRUE(std::includes(cells->marked.begin(), cells->marked.end(), cells->front.begin(), cells->front.end()));
    marked += cells->marked.size();
  }
  EXPECT_EQ(measure_mesh(tracker.mesh().positions(), tracker.mesh().triangles()).components, 1u);
  EXPECT_GT(marked, 0u);
  EXPECT_EQ(other.topology_cells(), nullptr);
}

}  // namespace
}  // namespace particle_surface_tracker
