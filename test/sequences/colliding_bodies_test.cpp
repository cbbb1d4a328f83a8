// The tracker on recorded sequences in which bodies collide, merge and split.

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/stages/advection.h"
#include "particle_surface_tracker/tracker/tracker.h"
#include "sequences/frame_judgement.h"
#include "sequences/sequence_data.h"
#include "sequences/solid_judge.h"

namespace particle_surface_tracker::test {

namespace {

/// How much farther from φ = 0 than by `average` a vertex may be carried by `affine` [r].
constexpr double kLargestExcess = 0.25;

/// Judging a frame takes as long as tracking it.
constexpr std::size_t kJudgedFrames = 10;

/// Largest differences over the vertices: distance to φ = 0 after `affine` minus that after `average` [r].
struct Excess {
  double anywhere = 0.0;
  double outside = 0.0;  ///< Of vertices that `affine` leaves outside: those that would be seen.
};

/// A difference of distances is at most the distance between the two positions, so vertices are looked at in falling
/// order of that, until no later one can have a larger difference.
Excess largest_excess(const std::vector<Vec3f>& affine, const std::vector<Vec3f>& average,
                      const SurfaceTriangulation& surface, double r) {
  std::vector<double> gaps(affine.size());
  for (std::size_t v = 0; v < affine.size(); ++v) {
    gaps[v] = (affine[v].cast<double>() - average[v].cast<double>()).norm() / r;
  }
  std::vector<std::size_t> order(affine.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return gaps[a] > gaps[b]; });
  const SolidJudge judge(surface.vertices, surface.triangles);
  Excess excess;
  for (const std::size_t v : order) {
    if (gaps[v] <= excess.outside) break;
    const bool is_outside = judge.winding_number(affine[v]) <= 0;
    if (!is_outside && gaps[v] <= excess.anywhere) continue;
    const double difference =
        (judge.distance(affine[v].cast<double>()) - judge.distance(average[v].cast<double>())) / r;
    excess.anywhere = std::max(excess.anywhere, difference);
    if (is_outside) excess.outside = std::max(excess.outside, difference);
  }
  return excess;
}

std::vector<Vec3f> advect_with(AdvectionMethod method, const TriangleMesh& mesh, const ParticleFrame& earlier,
                               const ParticleFrame& later, Parameters parameters) {
  parameters.advection = method;
  const ParticleMotion motion = match_particles(earlier, later, parameters);
  return advect(mesh.positions(), motion, ParticleGrid(motion.positions, parameters.particle_spacing), parameters);
}

class CollidingBodies : public testing::TestWithParam<std::string> {};

}  // namespace

TEST_P(CollidingBodies, AreTrackedWithoutSpikes) {
  PST_SKIP_WITHOUT(GetParam());
  const Sequence sequence = load_sequence(GetParam());
  Parameters parameters;
  parameters.particle_spacing = sequence.spacing;
  Tracker tracker(parameters);
  FrameReport report = tracker.start(sequence.mesh, sequence.frames[0]);
  const FrameJudgement first = judge_frame(tracker, sequence.frames[0], report, /*count_intersections=*/true);
  fmt::print("{}\n{}\n{}\n", GetParam(), judgement_header(), judgement_row(first, first));
  Excess worst;
  std::size_t worst_frame = 0;
  for (std::size_t n = 1; n < sequence.frames.size(); ++n) {
    const ParticleFrame& earlier = sequence.frames[n - 1];
    const ParticleFrame& later = sequence.frames[n];
    const auto affine = advect_with(AdvectionMethod::kAffine, tracker.mesh(), earlier, later, parameters);
    const auto average = advect_with(AdvectionMethod::kAverage, tracker.mesh(), earlier, later, parameters);
    report = tracker.advance(later, n);
    const Excess excess = largest_excess(affine, average, tracker.implicit_surface()->triangulation, sequence.spacing);
    if (excess.anywhere > worst.anywhere) worst_frame = n;
    worst = {std::max(worst.anywhere, excess.anywhere), std::max(worst.outside, excess.outside)};
    fmt::print(
        "frame {:3}: affine up to {:.3f} r farther from the isosurface than average, outside {:.3f} r; {} flagged\n", n,
        excess.anywhere, excess.outside, report.flagged_vertices);
    if (n % kJudgedFrames != 0 && n + 1 != sequence.frames.size()) continue;
    const FrameJudgement judgement = judge_frame(tracker, later, report, /*count_intersections=*/true);
    fmt::print("{}\n{}\n", judgement_header(), judgement_row(judgement, first));
    EXPECT_TRUE(judgement.is_manifold) << "frame " << n;
  }
  fmt::print(
      "{}: affine carries no vertex more than {:.3f} r farther from the isosurface than average (frame {}), none "
      "outside more than {:.3f} r\n",
      GetParam(), worst.anywhere, worst_frame, worst.outside);
  EXPECT_LE(worst.anywhere, kLargestExcess) << "frame " << worst_frame;
}

INSTANTIATE_TEST_SUITE_P(Recorded, CollidingBodies,
                         testing::Values("two_drops", "splitting_armadillo", "falling_objects"),
                         [](const testing::TestParamInfo<std::string>& tested) { return tested.param; });

}  // namespace particle_surface_tracker::test
