// The tracker on the recorded sequence melting_bunny: a viscous bunny falls onto a floor and melts.

#include <cstring>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "sequences/frame_judgement.h"
#include "sequences/ring_shape.h"
#include "sequences/sequence_data.h"

namespace particle_surface_tracker::test {

namespace {

constexpr const char* kName = "melting_bunny";

/// In this frame the tips of the ears touch the back. Before it, only a crease between chest and paw closes, in
/// frame 15.
constexpr std::size_t kFirstFold = 20;

/// Counting crossing triangles takes half a second.
constexpr std::size_t kIntersectionStride = 10;

/// The whole run, tracked and judged once for all tests.
struct TrackedRun {
  Sequence sequence;
  std::vector<FrameJudgement> judgements;
  std::vector<std::vector<Vec3f>> positions;    ///< Of the mesh, frame by frame [m].
  std::vector<std::vector<std::uint32_t>> ids;  ///< Of its vertices.
};

TrackedRun track_and_judge() {
  TrackedRun run;
  run.sequence = load_sequence(kName);
  Parameters parameters;
  parameters.particle_spacing = run.sequence.spacing;
  Tracker tracker(parameters);
  fmt::print("{}\n", judgement_header());
  for (std::size_t n = 0; n < run.sequence.frames.size(); ++n) {
    const ParticleFrame& frame = run.sequence.frames[n];
    const FrameReport report = n == 0 ? tracker.start(run.sequence.mesh, frame) : tracker.advance(frame, n);
    run.judgements.push_back(judge_frame(tracker, frame, report, n % kIntersectionStride == 0));
    run.positions.push_back(tracker.mesh().positions());
    run.ids.push_back(tracker.mesh().ids());
    fmt::print("{}\n", judgement_row(run.judgements.back(), run.judgements.front()));
  }
  return run;
}

const TrackedRun& whole_run() {
  static const TrackedRun run = track_and_judge();
  return run;
}

/// The mesh positions of the first frames, tracked with at most `threads` threads.
std::vector<std::vector<Vec3f>> track_with_threads(const Sequence& sequence, std::size_t threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  Parameters parameters;
  parameters.particle_spacing = sequence.spacing;
  Tracker tracker(parameters);
  std::vector<std::vector<Vec3f>> positions;
  for (std::size_t n = 0; n < sequence.frames.size(); ++n) {
    const ParticleFrame& frame = sequence.frames[n];
    n == 0 ? tracker.start(sequence.mesh, frame) : tracker.advance(frame, n);
    positions.push_back(tracker.mesh().positions());
  }
  return positions;
}

}  // namespace

TEST(MeltingBunny, KeepsItsParticles) {
  PST_SKIP_WITHOUT(kName);
  ASSERT_EQ(whole_run().judgements.size(), 100u);
  for (const FrameJudgement& judgement : whole_run().judgements) {
    EXPECT_GE(judgement.covered_share, 0.995) << "frame " << judgement.frame;
  }
}

TEST(MeltingBunny, KeepsItsVolume) {
  PST_SKIP_WITHOUT(kName);
  const double first = whole_run().judgements.front().volume_ratio;
  for (const FrameJudgement& judgement : whole_run().judgements) {
    EXPECT_NEAR(judgement.volume_ratio / first, 1.0, 0.05) << "frame " << judgement.frame;
  }
}

TEST(MeltingBunny, StaysClosedAndManifold) {
  PST_SKIP_WITHOUT(kName);
  for (const FrameJudgement& judgement : whole_run().judgements) {
    EXPECT_TRUE(judgement.is_manifold) << "frame " << judgement.frame;
  }
}

TEST(MeltingBunny, FlagsNextToNothingBeforeTheFirstFold) {
  PST_SKIP_WITHOUT(kName);
  for (std::size_t n = 0; n < kFirstFold; ++n) {
    EXPECT_LE(whole_run().judgements[n].flagged_share(), 0.001) << "frame " << n;
  }
}

TEST(MeltingBunny, KeepsShapesWhereItMovesRigidly) {
  PST_SKIP_WITHOUT(kName);
  const TrackedRun& run = whole_run();
  const double r = run.sequence.spacing;
  for (const std::size_t n : {5u, 9u, 12u, 16u, 19u, 22u, 25u}) {
    const std::vector<double> changes =
        ring_shape_changes(run.sequence.mesh.triangles(), run.positions[0], run.positions[n], run.ids[n],
                           run.sequence.frames[0], run.sequence.frames[n], r);
    const RingShapeSummary summary = summarize(changes);
    fmt::print(
        "frame {:3}: {:6} vertices among rigidly moving particles; one-rings change by {:.4f} r (median), {:.4f} r "
        "(95 %), {:.4f} r (largest), RMS\n",
        n, changes.size(), summary.median, summary.percentile_95, summary.largest);
    ASSERT_FALSE(changes.empty()) << "frame " << n;
    EXPECT_LE(summary.percentile_95, 0.02) << "frame " << n;
    if (n < kFirstFold) {
      EXPECT_LE(summary.largest, 0.02) << "frame " << n;
    }
  }
}

TEST(MeltingBunny, IsTheSameForAnyNumberOfThreads) {
  PST_SKIP_WITHOUT(kName);
  const Sequence sequence = load_sequence(kName, 10);
  const auto one = track_with_threads(sequence, 1);
  const auto two = track_with_threads(sequence, 2);
  const auto again = track_with_threads(sequence, 2);
  for (std::size_t n = 0; n < one.size(); ++n) {
    ASSERT_EQ(one[n].size(), two[n].size());
    const std::size_t bytes = one[n].size() * sizeof(Vec3f);
    EXPECT_EQ(std::memcmp(one[n].data(), two[n].data(), bytes), 0) << "one and two threads, frame " << n;
    EXPECT_EQ(std::memcmp(two[n].data(), again[n].data(), bytes), 0) << "two threads twice, frame " << n;
  }
}

}  // namespace particle_surface_tracker::test
