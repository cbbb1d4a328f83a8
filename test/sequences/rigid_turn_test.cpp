#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "particle_surface_tracker/tracker/tracker.h"
#include "sequences/mesh_judge.h"
#include "sequences/solid_judge.h"
#include "support/detailed_body.h"

namespace particle_surface_tracker::test {

namespace {

constexpr double kSpacing = 0.03;
constexpr int kSteps = 60;

/// How far a mesh is from where it belongs after a full turn. Lengths in r.
struct TurnResult {
  double vertex_rms = 0.0;  ///< Distance of the vertices from their places.
  double vertex_max = 0.0;
  double surface_rms = 0.0;  ///< Distance of the vertices from the surface.
  double surface_max = 0.0;
  std::size_t flagged = 0;  ///< Vertices and cells, sum over all steps.
  std::size_t lost = 0;     ///< Vertices that are not there any more.
};

ParticleFrame turned_by(const ParticleFrame& frame, const Eigen::Affine3d& turn) {
  std::vector<Vec3f> positions;
  for (const Vec3f& p : frame.positions) positions.push_back((turn * p.cast<double>()).cast<float>());
  return make_particle_frame(0, std::move(positions), frame.ids);
}

/// Turns the particles once around a slanted axis that does not pass through the body's centre. Every step is made from
/// the first frame, so that the particles' own motion is rigid to float accuracy.
TurnResult turn_once(AdvectionMethod method, double jitter) {
  const DetailedBody body(kSpacing);
  const TriangleMesh mesh = body.mesh();
  const ParticleFrame particles = body.particles(jitter);
  const Eigen::Translation3d pivot(body.center() + kSpacing * Vec3d(9.0, -4.0, 6.0));
  const Vec3d axis = Vec3d(1.0, 2.0, 3.0).normalized();

  Parameters parameters;
  parameters.particle_spacing = kSpacing;
  parameters.advection = method;
  Tracker tracker(parameters);
  TurnResult result;
  tracker.start(mesh, particles);
  for (int step = 1; step <= kSteps; ++step) {
    const double angle = 2.0 * std::acos(-1.0) * step / kSteps;
    const Eigen::Affine3d turn = pivot * Eigen::AngleAxisd(angle, axis) * pivot.inverse();
    const FrameReport report = tracker.advance(turned_by(particles, turn), static_cast<std::uint64_t>(step));
    result.flagged += report.flagged_vertices + report.flagged_cells;
  }

  const SolidJudge start(mesh.positions(), mesh.triangles());
  result.lost = mesh.vertex_count();
  // Upkeep takes a few slivers out where the body is thinner than r.
  for (std::size_t n = 0; n < tracker.mesh().vertex_count(); ++n) {
    const Vec3d position = tracker.mesh().positions()[n].cast<double>();
    if (tracker.mesh().ids()[n] >= mesh.vertex_count()) continue;
    --result.lost;
    const Vec3d place = mesh.positions()[tracker.mesh().ids()[n]].cast<double>();
    const double from_place = (position - place).norm() / kSpacing;
    const double from_surface = start.distance(position) / kSpacing;
    result.vertex_rms += from_place * from_place;
    result.surface_rms += from_surface * from_surface;
    result.vertex_max = std::max(result.vertex_max, from_place);
    result.surface_max = std::max(result.surface_max, from_surface);
  }
  result.vertex_rms = std::sqrt(result.vertex_rms / static_cast<double>(mesh.vertex_count()));
  result.surface_rms = std::sqrt(result.surface_rms / static_cast<double>(mesh.vertex_count()));
  return result;
}

TurnResult turn_and_report(const std::string& name, AdvectionMethod method, double jitter) {
  const TurnResult result = turn_once(method, jitter);
  fmt::print("{:<22} vertices {:.4f} r RMS, {:.3f} r max; surface {:.4f} r RMS, {:.3f} r max; flagged {}, lost {}\n",
             name, result.vertex_rms, result.vertex_max, result.surface_rms, result.surface_max, result.flagged,
             result.lost);
  return result;
}

void expect_exact(const TurnResult& result) {
  EXPECT_LE(result.vertex_rms, 0.02);
  EXPECT_LE(result.vertex_max, 0.3);
  EXPECT_LE(result.surface_rms, 0.01);
  EXPECT_EQ(result.flagged, 0u);
  EXPECT_LE(result.lost, 10u);
}

}  // namespace

TEST(RigidTurn, TheBodyIsWhatItShouldBe) {
  const DetailedBody body(kSpacing);
  const TriangleMesh mesh = body.mesh();
  EXPECT_TRUE(find_surface_defects(mesh.vertex_count(), mesh.triangles()).none());
  EXPECT_EQ(count_self_intersecting_triangles(mesh.positions(), mesh.triangles()), 0u);
  EXPECT_GT(enclosed_volume(mesh.positions(), mesh.triangles()), 0.0);
  const std::size_t particles = body.particles(0.0).size();
  fmt::print("{} particles, {} vertices, {} triangles\n", particles, mesh.vertex_count(), mesh.triangle_count());
  EXPECT_GE(particles, 15000u);
  EXPECT_LE(particles, 30000u);
}

TEST(RigidTurn, AffineReturnsOnAPlainGrid) {
  expect_exact(turn_and_report("affine, plain grid", AdvectionMethod::kAffine, 0.0));
}

TEST(RigidTurn, AffineReturnsOnAJitteredGrid) {
  expect_exact(turn_and_report("affine, jittered grid", AdvectionMethod::kAffine, 0.25));
}

/// The paper's method, for comparison: it must be seen to fall behind, or the test above shows nothing.
TEST(RigidTurn, AverageFallsBehind) {
  EXPECT_GT(turn_and_report("average, plain grid", AdvectionMethod::kAverage, 0.0).vertex_rms, 0.5);
  EXPECT_GT(turn_and_report("average, jittered grid", AdvectionMethod::kAverage, 0.25).vertex_rms, 0.5);
}

}  // namespace particle_surface_tracker::test
