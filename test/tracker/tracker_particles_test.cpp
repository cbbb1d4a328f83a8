#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/tracker/tracker.h"
#include "support/parameters.h"
#include "tracker_cases.h"

namespace particle_surface_tracker {
namespace {

using test::r;
using ::testing::HasSubstr;

TEST(TrackerParticles, WaitsWhileThereAreNoParticlesAndGoesOnWhenTheyReturn) {
  const TriangleMesh mesh = test::rippled_ball();
  const ParticleFrame particles = test::ball_of_particles();
  Tracker tracker(test::parameters_with_spacing(r));
  tracker.start(mesh, particles);
  const FrameReport gone = tracker.advance(ParticleFrame{}, 1);
  EXPECT_EQ(gone.particles, 0u);
  EXPECT_EQ(gone.particles_gone, particles.size());
  ASSERT_EQ(gone.warnings.size(), 1u);
  EXPECT_THAT(gone.warnings[0], HasSubstr("no particles"));
  EXPECT_EQ(tracker.mesh().positions(), mesh.positions());
  const FrameReport back = tracker.advance(test::shifted(particles, {0.1, 0, 0}), 2);
  EXPECT_EQ(back.flagged_vertices, 0u);
  double mean = 0.0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    mean += tracker.mesh().positions()[v].x() - mesh.positions()[v].x();
  EXPECT_NEAR(mean / static_cast<double>(mesh.vertex_count()), 0.1, 1e-3);
}

TEST(TrackerParticles, RecycledIdsAndTeleportsMoveNothing) {
  const TriangleMesh mesh = test::rippled_ball();
  const ParticleFrame particles = test::ball_of_particles();
  Tracker tracker(test::parameters_with_spacing(r));
  tracker.start(mesh, particles);
  ParticleFrame next = test::shifted(particles, {0.02, 0, 0});
  next.positions[10] += Vec3f(0, 50, 0);
  next.positions[11] += Vec3f(0, -1.5f, 0);
  const FrameReport report = tracker.advance(next, 1);
  EXPECT_EQ(report.particles_born, 2u);
  EXPECT_EQ(report.particles_gone, 2u);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    ASSERT_LT((tracker.mesh().positions()[v] - mesh.positions()[v]).norm(), 0.5 * r);
  }
}

TEST(TrackerParticles, WithOtherIdsTheMeshIsNotAdvectedAndTheReportSaysSo) {
  Tracker tracker(test::parameters_with_spacing(r));
  const ParticleFrame particles = test::ball_of_particles();
  tracker.start(test::rippled_ball(), particles);
  ParticleFrame strangers = particles;
  for (std::uint32_t& id : strangers.ids) id += 1000000;
  const FrameReport report = tracker.advance(strangers, 1);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_THAT(report.warnings[0], HasSubstr("not advected"));
  EXPECT_EQ(report.flagged_vertices, 0u);
}

TEST(TrackerParticles, IdsThatArePlacesInASortedArrayAreWarnedOf) {
  const auto frame_with_reversed = [](double share) {
    ParticleFrame frame = test::ball_of_particles();
    const auto count = static_cast<std::ptrdiff_t>(share * static_cast<double>(frame.size()));
    std::reverse(frame.positions.begin(), frame.positions.begin() + count);
    return frame;
  };
  Parameters parameters = test::parameters_with_spacing(r);
  parameters.max_displacement = 3.0;
  Tracker tracker(parameters);
  tracker.start(test::rippled_ball(), test::ball_of_particles());
  const FrameReport sorted = tracker.advance(frame_with_reversed(1.0), 1);
  ASSERT_FALSE(sorted.warnings.empty());
  EXPECT_THAT(sorted.warnings[0], HasSubstr("% of the particles vanished, and as many appeared"));
  EXPECT_THAT(sorted.warnings[0], HasSubstr("ids"));

  tracker.start(test::rippled_ball(), test::ball_of_particles());
  const FrameReport few = tracker.advance(frame_with_reversed(0.2), 1);
  EXPECT_GT(few.particles_born, 100u);
  EXPECT_TRUE(few.warnings.empty()) << few.warnings[0];
}

TEST(TrackerParticles, LiquidThatComesOrGoesIsNotWarnedOf) {
  Tracker tracker(test::parameters_with_spacing(r));
  const ParticleFrame all = test::ball_of_particles();
  ParticleFrame half;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all.positions[i].x() > 0) continue;
    half.positions.push_back(all.positions[i]);
    half.ids.push_back(all.ids[i]);
  }
  tracker.start_from_particles(all);
  EXPECT_TRUE(tracker.advance(half, 1).warnings.empty());
  EXPECT_TRUE(tracker.advance(all, 2).warnings.empty());
}

TEST(TrackerParticles, ASpacingThatIsNotTheirsIsRefusedBeforeASurfaceIsMade) {
  for (const double spacing : {r / 1000, r / 5, 5 * r, 1000 * r}) {
    Tracker tracker(test::parameters_with_spacing(spacing));
    EXPECT_THAT([&] { tracker.start_from_particles(test::ball_of_particles()); },
                testing::ThrowsMessage<TrackingError>(HasSubstr("the particle spacing is given as")))
        << spacing;
    EXPECT_FALSE(tracker.started());
  }
  Tracker tracker(test::parameters_with_spacing(r));
  EXPECT_NO_THROW(tracker.start_from_particles(test::ball_of_particles()));
}

TEST(TrackerParticles, AFewDropsFarApartHaveNoSpacing) {
  std::vector<Vec3f> positions;
  std::vector<std::uint32_t> ids;
  for (std::uint32_t drop = 0; drop < 9; ++drop) {
    positions.emplace_back(static_cast<float>(20.0 * r * drop), 0.0F, 0.0F);
    ids.push_back(drop);
  }
  Tracker tracker(test::parameters_with_spacing(r));
  EXPECT_EQ(tracker.start_from_particles(make_particle_frame(0, positions, ids)).components, 9U);
}

TEST(TrackerParticles, FollowsASingleParticle) {
  const auto at = [](float x) { return make_particle_frame(0, {{x, 0, 0}}, {7}); };
  Tracker tracker(test::parameters_with_spacing(r));
  tracker.start_from_particles(at(0.0f));
  const std::size_t vertices = tracker.mesh().vertex_count();
  EXPECT_GT(vertices, 20u);
  for (int frame = 1; frame <= 20; ++frame) {
    const FrameReport report =
        tracker.advance(at(0.033f * static_cast<float>(frame)), static_cast<std::uint64_t>(frame));
    EXPECT_EQ(report.flagged_vertices, 0u);
    EXPECT_EQ(report.components, 1u);
  }
  Vec3d center = Vec3d::Zero();
  for (const Vec3f& p : tracker.mesh().positions()) center += p.cast<double>() / static_cast<double>(vertices);
  EXPECT_LT((center - Vec3d(0.66, 0, 0)).norm(), 0.1 * r);
}

}  // namespace
}  // namespace particle_surface_tracker
