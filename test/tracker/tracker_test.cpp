#include "particle_surface_tracker/tracker/tracker.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <Eigen/Geometry>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/mesh_measures.h"
#include "support/parameters.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using ::testing::HasSubstr;

constexpr double r = 0.1;

/// A sphere with ripples finer than r, and the particles in it.
TriangleMesh rippled_ball() {
  TriangleMesh mesh = test::make_sphere(Vec3d::Zero(), 1.0, 5);
  for (Vec3f& x : mesh.positions()) {
    x *= 1.0f + 0.02f * std::sin(25.0f * x.x()) * std::sin(25.0f * x.y()) * std::sin(25.0f * x.z());
  }
  return mesh;
}

ParticleFrame ball_of_particles(double jitter = 0.2) {
  return test::fill_with_particles(Vec3d::Constant(-1.0), Vec3d::Constant(1.0), r, jitter, 9,
                                   [](const Vec3d& x) { return x.norm() < 1.0 - 0.1 * r; });
}

template <typename Map>
ParticleFrame moved(const ParticleFrame& frame, Map&& map) {
  ParticleFrame result = frame;
  for (Vec3f& p : result.positions) p = map(p.cast<double>()).template cast<float>();
  return result;
}

ParticleFrame shifted(const ParticleFrame& frame, const Vec3d& by) {
  return moved(frame, [&](const Vec3d& x) { return Vec3d(x + by); });
}

TEST(Tracker, TheFirstFrameIsTheMeshItWasGiven) {
  Tracker tracker(test::parameters_with_spacing(r));
  EXPECT_FALSE(tracker.started());
  const TriangleMesh mesh = rippled_ball();
  const FrameReport report = tracker.start(mesh, ball_of_particles(), 3);
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
  const TriangleMesh mesh = rippled_ball();
  const ParticleFrame particles = ball_of_particles();
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
  const TriangleMesh mesh = rippled_ball();
  const ParticleFrame particles = ball_of_particles();
  Tracker tracker(test::parameters_with_spacing(r));
  tracker.start(mesh, particles);
  const Vec3d axis = Vec3d(1, -2, 0.5).normalized();
  for (std::uint64_t frame = 1; frame <= 15; ++frame) {
    const Eigen::AngleAxisd turn(0.1 * static_cast<double>(frame), axis);
    const FrameReport report =
        tracker.advance(moved(particles, [&](const Vec3d& x) { return Vec3d(turn * x); }), frame);
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
  EXPECT_THROW(tracker.advance(ball_of_particles(), 1), TrackingError);
  EXPECT_EQ(tracker.mesh().vertex_count(), 0u);
  EXPECT_EQ(tracker.implicit_surface(), nullptr);
}

TEST(Tracker, RefusesBadBeginningsAndStaysAsItWas) {
  Tracker tracker(test::parameters_with_spacing(r));
  tracker.start(rippled_ball(), ball_of_particles());
  const std::vector<Vec3f> before = tracker.mesh().positions();
  EXPECT_THROW(tracker.start(rippled_ball(), ParticleFrame{}), ParticleError);
  EXPECT_THROW(tracker.start_from_particles(ParticleFrame{}), ParticleError);
  EXPECT_THROW(tracker.start(test::make_sphere(Vec3d(9, 9, 9), 1.0, 2), ball_of_particles()), TrackingError);
  TriangleMesh open = rippled_ball();
  std::vector<Triangle> triangles = open.triangles();
  triangles.pop_back();
  open.set_triangles(triangles);
  EXPECT_THROW(tracker.start(open, ball_of_particles()), MeshError);
  EXPECT_EQ(tracker.mesh().positions(), before);
  EXPECT_EQ(tracker.advance(ball_of_particles(), 1).flagged_vertices, 0u);
}

TEST(Tracker, WaitsWhileThereAreNoParticlesAndGoesOnWhenTheyReturn) {
  const TriangleMesh mesh = rippled_ball();
  const ParticleFrame particles = ball_of_particles();
  Tracker tracker(test::parameters_with_spacing(r));
  tracker.start(mesh, particles);
  const FrameReport gone = tracker.advance(ParticleFrame{}, 1);
  EXPECT_EQ(gone.particles, 0u);
  EXPECT_EQ(gone.particles_gone, particles.size());
  ASSERT_EQ(gone.warnings.size(), 1u);
  EXPECT_THAT(gone.warnings[0], HasSubstr("no particles"));
  EXPECT_EQ(tracker.mesh().positions(), mesh.positions());
  const FrameReport back = tracker.advance(shifted(particles, {0.1, 0, 0}), 2);
  EXPECT_EQ(back.flagged_vertices, 0u);
  double mean = 0.0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
    mean += tracker.mesh().positions()[v].x() - mesh.positions()[v].x();
  EXPECT_NEAR(mean / static_cast<double>(mesh.vertex_count()), 0.1, 1e-3);
}

TEST(Tracker, RecycledIdsAndTeleportsMoveNothing) {
  const TriangleMesh mesh = rippled_ball();
  const ParticleFrame particles = ball_of_particles();
  Tracker tracker(test::parameters_with_spacing(r));
  tracker.start(mesh, particles);
  ParticleFrame next = shifted(particles, {0.02, 0, 0});
  next.positions[10] += Vec3f(0, 50, 0);
  next.positions[11] += Vec3f(0, -1.5f, 0);
  const FrameReport report = tracker.advance(next, 1);
  EXPECT_EQ(report.particles_born, 2u);
  EXPECT_EQ(report.particles_gone, 2u);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    ASSERT_LT((tracker.mesh().positions()[v] - mesh.positions()[v]).norm(), 0.5 * r);
  }
}

TEST(Tracker, WithOtherIdsTheMeshIsNotAdvectedAndTheReportSaysSo) {
  Tracker tracker(test::parameters_with_spacing(r));
  const ParticleFrame particles = ball_of_particles();
  tracker.start(rippled_ball(), particles);
  ParticleFrame strangers = particles;
  for (std::uint32_t& id : strangers.ids) id += 1000000;
  const FrameReport report = tracker.advance(strangers, 1);
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_THAT(report.warnings[0], HasSubstr("not advected"));
  EXPECT_EQ(report.flagged_vertices, 0u);
}

TEST(Tracker, FollowsASingleParticle) {
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

TEST(Tracker, FlagsVerticesWhoseLiquidHasGone) {
  // A second drop vanishes.
  const ParticleFrame both =
      test::fill_with_particles(Vec3d(-0.6, -0.6, -0.6), Vec3d(2.6, 0.6, 0.6), r, 0.1, 4,
                                [](const Vec3d& x) { return std::min(x.norm(), (x - Vec3d(2, 0, 0)).norm()) < 0.5; });
  ParticleFrame one;
  for (std::size_t i = 0; i < both.size(); ++i) {
    if (both.positions[i].x() > 1.0f) continue;
    one.positions.push_back(both.positions[i]);
    one.ids.push_back(both.ids[i]);
  }
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

TEST(Tracker, RecordsTheCellsOfAMergeAndTracksAsWithout) {
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
    const ParticleFrame frame =
        moved(drops, [n](const Vec3d& x) { return Vec3d(x - Vec3d(x.x() > 0.0 ? 0.02 * n : -0.02 * n, 0.0, 0.0)); });
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

TEST(Tracker, SameBytesWithOneAndTwoThreads) {
  const ParticleFrame particles = ball_of_particles();
  const auto run = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    Tracker tracker(test::parameters_with_spacing(r));
    tracker.start(rippled_ball(), particles);
    for (std::uint64_t frame = 1; frame <= 5; ++frame) {
      const double t = 0.05 * static_cast<double>(frame);
      tracker.advance(moved(particles,
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
  tracker.start(rippled_ball(), ball_of_particles());
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
