#include "particle_surface_tracker/tracker/tracker.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <Eigen/Geometry>

#include "particle_surface_tracker/core/error.h"
#include "support/parameters.h"
#include "support/shapes.h"
#include "tracker_cases.h"

namespace particle_surface_tracker {
namespace {

using test::r;

TEST(Tracker, TheFirstFrameIsTheMeshItWasGiven) {
  Tracker tracker(test::parameters_with_spacing(r));
  EXPECT_FALSE(tracker.started());
  const TriangleMesh mesh = test::rippled_ball();
  const FrameReport report = tracker.start(mesh, test::ball_of_particles(), 3);
  EXPECT_TRUE(tracker.started());
  EXPECT_EQ(tracker.mesh().positions(), mesh.positions());
  EXPECT_EQ(report.frame, 3u);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.genus, 0);
  EXPECT_EQ(report.original_vertices_alive, mesh.vertex_count());
  EXPECT_NEAR(report.volume, 4.0 / 3.0 * 3.14159265, 0.02);
  EXPECT_NEAR(report.implicit_volume, report.volume, 0.1 * report.volume);
  EXPECT_GT(report.max_abs_delta, 0.01);
  EXPECT_LT(report.max_abs_delta, r);
  EXPECT_TRUE(report.warnings.empty());
  EXPECT_GT(report.total_time, 0.0);
  EXPECT_GT(report.peak_rss_bytes, 0u);
}

TEST(Tracker, RestLeavesEveryBitAlsoWhenTheArrayIsShuffled) {
  const TriangleMesh mesh = test::rippled_ball();
  const ParticleFrame particles = test::ball_of_particles();
  Tracker tracker(test::parameters_with_spacing(r));
  tracker.start(mesh, particles);
  const std::vector<float> delta = tracker.mesh().delta();
  std::mt19937 random(1);
  std::vector<std::uint32_t> order = particles.ids;
  for (std::uint64_t frame = 1; frame <= 100; ++frame) {
    std::shuffle(order.begin(), order.end(), random);
    std::vector<Vec3f> positions;
    for (const std::uint32_t i : order) positions.push_back(particles.positions[i]);
    const FrameReport report = tracker.advance(make_particle_frame(0, std::move(positions), order), frame);
    ASSERT_EQ(report.flagged_vertices, 0u);
  }
  EXPECT_EQ(tracker.mesh().positions(), mesh.positions());
  EXPECT_EQ(tracker.mesh().delta(), delta);
}

TEST(Tracker, CarriesDetailThroughATurn) {
  const TriangleMesh mesh = test::rippled_ball();
  const ParticleFrame particles = test::ball_of_particles();
  Tracker tracker(test::parameters_with_spacing(r));
  tracker.start(mesh, particles);
  const Vec3d axis = Vec3d(1, -2, 0.5).normalized();
  for (std::uint64_t frame = 1; frame <= 15; ++frame) {
    const Eigen::AngleAxisd turn(0.1 * static_cast<double>(frame), axis);
    const FrameReport report =
        tracker.advance(test::moved(particles, [&](const Vec3d& x) { return Vec3d(turn * x); }), frame);
    ASSERT_EQ(report.flagged_vertices, 0u);
  }
  const Eigen::AngleAxisd turn(1.5, axis);
  double squared = 0.0;
  double largest = 0.0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const double error =
        (tracker.mesh().positions()[v].cast<double>() - turn * mesh.positions()[v].cast<double>()).norm();
    squared += error * error;
    largest = std::max(largest, error);
  }
  EXPECT_LT(std::sqrt(squared / static_cast<double>(mesh.vertex_count())), 0.02 * r);
  EXPECT_LT(largest, 0.3 * r);
}

TEST(Tracker, MeasuresNothingBeforeItIsStarted) {
  Tracker tracker(test::parameters_with_spacing(r));
  EXPECT_THROW(tracker.advance(test::ball_of_particles(), 1), TrackingError);
  EXPECT_EQ(tracker.mesh().vertex_count(), 0u);
  EXPECT_EQ(tracker.implicit_surface(), nullptr);
}

TEST(Tracker, RefusesBadBeginningsAndStaysAsItWas) {
  Tracker tracker(test::parameters_with_spacing(r));
  tracker.start(test::rippled_ball(), test::ball_of_particles());
  const std::vector<Vec3f> before = tracker.mesh().positions();
  EXPECT_THROW(tracker.start(test::rippled_ball(), ParticleFrame{}), ParticleError);
  EXPECT_THROW(tracker.start_from_particles(ParticleFrame{}), ParticleError);
  EXPECT_THROW(tracker.start(test::make_sphere(Vec3d(9, 9, 9), 1.0, 2), test::ball_of_particles()), TrackingError);
  TriangleMesh open = test::rippled_ball();
  std::vector<Triangle> triangles = open.triangles();
  triangles.pop_back();
  open.set_triangles(triangles);
  EXPECT_THROW(tracker.start(open, test::ball_of_particles()), MeshError);
  EXPECT_EQ(tracker.mesh().positions(), before);
  EXPECT_EQ(tracker.advance(test::ball_of_particles(), 1).flagged_vertices, 0u);
}

TEST(Tracker, SameBytesWithOneAndTwoThreads) {
  const ParticleFrame particles = test::ball_of_particles();
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    Tracker tracker(test::parameters_with_spacing(r));
    tracker.start(test::rippled_ball(), particles);
    for (std::uint64_t frame = 1; frame <= 5; ++frame) {
      const double t = 0.05 * static_cast<double>(frame);
      tracker.advance(test::moved(particles,
                                  [&](const Vec3d& x) {
                                    const Eigen::AngleAxisd twist(t * x.y(), Vec3d::UnitY());
                                    return Vec3d(twist * x);
                                  }),
                      frame);
    }
    return tracker.mesh().positions();
  };
  EXPECT_EQ(run(1), run(2));
}

TEST(Tracker, ParametersChangeBetweenFramesUnlessTheyNeedAReset) {
  Tracker tracker(test::parameters_with_spacing(r));
  tracker.start(test::rippled_ball(), test::ball_of_particles());
  Parameters changed = test::parameters_with_spacing(r);
  changed.tau = 0.3;
  tracker.set_parameters(changed);
  EXPECT_EQ(tracker.parameters().tau, 0.3);
  changed.dx_phi = 0.4;
  EXPECT_THROW(tracker.set_parameters(changed), ParameterError);
  EXPECT_EQ(tracker.parameters().dx_phi, 0.5);
  changed = test::parameters_with_spacing(r);
  changed.epsilon = 2.0;
  EXPECT_THROW(tracker.set_parameters(changed), ParameterError);
  EXPECT_THROW(Tracker(Parameters{}), ParameterError);
}

}  // namespace
}  // namespace particle_surface_tracker
