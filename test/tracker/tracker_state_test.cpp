// A tracker that goes on from the state of another one does what that one does, byte for byte.

#include "particle_surface_tracker/tracker/tracker_state.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/checkpoint.h"
#include "particle_surface_tracker/tracker/make_implicit_surface.h"
#include "particle_surface_tracker/tracker/tracker.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"

namespace particle_surface_tracker {
namespace {

constexpr double r = 0.1;
constexpr std::uint64_t kFrames = 14;
constexpr std::uint64_t kEmptyFrame = 6;

Parameters parameters() {
  Parameters p;
  p.particle_spacing = r;
  p.delta_half_life = 5.0;
  return p;
}

/// Two drops that run into each other while one of them is drawn out; then a few particles leave. One frame is empty.
ParticleFrame drops(std::uint64_t frame) {
  static const ParticleFrame start = test::fill_with_particles(
      Vec3d(-1.2, -0.6, -0.6), Vec3d(1.2, 0.6, 0.6), r, 0.2, 3,
      [](const Vec3d& x) { return std::min((x - Vec3d(-0.6, 0, 0)).norm(), (x - Vec3d(0.6, 0.1, 0)).norm()) < 0.45; });
  if (frame == kEmptyFrame) return {};
  ParticleFrame moved = start;
  const float t = static_cast<float>(frame);
  for (Vec3f& x : moved.positions) {
    x.y() *= 1.0F + 0.03F * t;
    x.x() += x.x() < 0.0F ? 0.02F * t : -0.02F * t;
    if (x.z() > 0.35F) x.z() += 0.04F * t;
  }
  moved.stamp_ns = static_cast<std::int64_t>(frame) * 40000000;
  return moved;
}

/// A mesh with everything that vertices can carry.
TriangleMesh colored_drops() {
  Tracker tracker(parameters());
  tracker.start_from_particles(drops(0));
  TriangleMesh mesh(tracker.mesh().positions(), tracker.mesh().triangles());
  VertexAttributes& attributes = mesh.attributes();
  attributes.add(TriangleMesh::color_name, 4, {1.0F, 1.0F, 1.0F, 1.0F});
  for (std::uint32_t v = 0; v < mesh.vertex_count(); v += 3) attributes[attributes.count() - 1].values[4 * v] = 0.25F;
  return mesh;
}

void expect_same(const Tracker& a, const Tracker& b) {
  EXPECT_EQ(a.mesh().positions(), b.mesh().positions());
  EXPECT_EQ(a.mesh().triangles(), b.mesh().triangles());
  EXPECT_EQ(a.mesh().ids(), b.mesh().ids());
  EXPECT_EQ(a.mesh().next_id(), b.mesh().next_id());
  ASSERT_EQ(a.mesh().attributes().count(), b.mesh().attributes().count());
  for (std::size_t n = 0; n < a.mesh().attributes().count(); ++n) {
    EXPECT_EQ(a.mesh().attributes()[n].name, b.mesh().attributes()[n].name);
    // As bits: what a stage remembers may be no number.
    const std::vector<float>& values = a.mesh().attributes()[n].values;
    const std::vector<float>& others = b.mesh().attributes()[n].values;
    ASSERT_EQ(values.size(), others.size());
    EXPECT_EQ(std::memcmp(values.data(), others.data(), values.size() * sizeof(float)), 0);
  }
  EXPECT_EQ(a.detection().flagged_vertices, b.detection().flagged_vertices);
  EXPECT_EQ(a.detection().flagged_cells, b.detection().flagged_cells);
  EXPECT_EQ(a.implicit_surface()->triangulation.vertices, b.implicit_surface()->triangulation.vertices);
  EXPECT_EQ(a.implicit_surface()->triangulation.triangles, b.implicit_surface()->triangulation.triangles);
}

void expect_same(const FrameReport& a, const FrameReport& b) {
  EXPECT_EQ(a.volume, b.volume);
  EXPECT_EQ(a.implicit_volume, b.implicit_volume);
  EXPECT_EQ(a.particles_born, b.particles_born);
  EXPECT_EQ(a.flagged_cells, b.flagged_cells);
  EXPECT_EQ(a.original_vertices_alive, b.original_vertices_alive);
  EXPECT_EQ(a.topology.new_vertices, b.topology.new_vertices);
  EXPECT_EQ(a.upkeep.splits, b.upkeep.splits);
  EXPECT_EQ(a.warnings, b.warnings);
}

TEST(TrackerState, GoesOnFromEveryFrameThroughAFile) {
  const test::TemporaryFolder folder;
  Tracker whole(parameters());
  whole.start(colored_drops(), drops(0));
  Tracker resumed(whole.state());
  std::size_t remeshed = 0;
  for (std::uint64_t frame = 1; frame <= kFrames; ++frame) {
    const FrameReport report = whole.advance(drops(frame), frame);
    expect_same(resumed.advance(drops(frame), frame), report);
    remeshed += report.topology.new_vertices;
    SCOPED_TRACE(frame);
    expect_same(resumed, whole);
    write_checkpoint(folder / "a", {resumed.state(), {}});
    resumed = Tracker(read_checkpoint(folder / "a").tracker);
    expect_same(resumed, whole);
    if (HasFailure()) return;
  }
  EXPECT_GT(remeshed, 0u) << "nothing was re-meshed: the test asks for too little";
}

TEST(TrackerState, OneStateServesManyFramesLater) {
  Tracker whole(parameters());
  whole.start(colored_drops(), drops(0));
  for (std::uint64_t frame = 1; frame <= 4; ++frame) whole.advance(drops(frame), frame);
  Tracker resumed(whole.state());
  for (std::uint64_t frame = 5; frame <= kFrames; ++frame) {
    whole.advance(drops(frame), frame);
    resumed.advance(drops(frame), frame);
  }
  expect_same(resumed, whole);
}

TEST(TrackerState, ASurfaceMadeBeforeGivesTheSameBytes) {
  Tracker whole(parameters());
  Tracker given(parameters());
  whole.start(colored_drops(), drops(0));
  given.start(colored_drops(), drops(0));
  for (std::uint64_t frame = 1; frame <= kFrames; ++frame) {
    const auto surface = drops(frame).empty() ? nullptr : make_implicit_surface(drops(frame), parameters());
    expect_same(given.advance(drops(frame), frame, surface), whole.advance(drops(frame), frame));
    expect_same(given, whole);
    EXPECT_EQ(given.implicit_surface() == surface, frame != kEmptyFrame);
  }
}

TEST(TrackerState, ASurfaceOfOtherCellsIsRefused) {
  Tracker tracker(parameters());
  tracker.start_from_particles(drops(0));
  Parameters finer = parameters();
  finer.dx_phi = 0.4;
  const std::vector<Vec3f> before = tracker.mesh().positions();
  EXPECT_THROW(tracker.advance(drops(1), 1, make_implicit_surface(drops(1), finer)), TrackingError);
  EXPECT_EQ(tracker.mesh().positions(), before);
}

TEST(TrackerState, ThereIsNoneBeforeTheFirstFrameAndBadOnesAreRefused) {
  EXPECT_THROW(Tracker(parameters()).state(), TrackingError);
  Tracker tracker(parameters());
  tracker.start_from_particles(drops(0));
  const TrackerState good = tracker.state();
  EXPECT_NO_THROW(check_tracker_state(good));

  TrackerState bad = good;
  bad.parameters.tau = -1.0;
  EXPECT_THROW(Tracker{bad}, ParameterError);
  bad = good;
  bad.frame.particles = {};
  EXPECT_THROW(Tracker{bad}, ParticleError);
  bad = good;
  bad.frame.particles.positions[3].x() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(Tracker{bad}, ParticleError);
  bad = good;
  bad.frame.mesh.positions()[0].y() = std::numeric_limits<float>::infinity();
  EXPECT_THROW(Tracker{bad}, MeshError);
  bad = good;
  bad.frame.band = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Tracker{bad}, TrackingError);
  bad = good;
  bad.frame.detection.flagged_vertices = {static_cast<std::uint32_t>(bad.frame.mesh.vertex_count())};
  EXPECT_THROW(Tracker{bad}, TrackingError);
}

}  // namespace
}  // namespace particle_surface_tracker
