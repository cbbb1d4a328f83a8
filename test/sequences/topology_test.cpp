// The tracker on whole recorded sequences in which liquid splits and merges.

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/tracker/tracker.h"
#include "sequences/sequence_data.h"
#include "sequences/topology_figures.h"

namespace particle_surface_tracker::test {

namespace {

class Topology : public testing::TestWithParam<std::string> {};

std::vector<TopologyFigures> track_and_judge(const Sequence& sequence) {
  Parameters parameters;
  parameters.particle_spacing = sequence.spacing;
  Tracker tracker(parameters);
  TopologyFigureTaker taker(tracker);
  std::vector<TopologyFigures> figures;
  fmt::print("{}\n", topology_header());
  for (std::size_t n = 0; n < sequence.frames.size(); ++n) {
    const ParticleFrame& frame = sequence.frames[n];
    const FrameReport report = n == 0 ? tracker.start(sequence.mesh, frame) : tracker.advance(frame, n);
    figures.push_back(taker.take(frame, report));
    fmt::print("{}\n", topology_row(figures.back(), figures.front()));
  }
  return figures;
}

}  // namespace

TEST_P(Topology, FollowsTheLiquid) {
  PST_SKIP_WITHOUT(GetParam());
  const std::vector<TopologyFigures> figures = track_and_judge(load_sequence(GetParam()));
  const SequenceLimits limits = limits_for(GetParam());
  fmt::print("{}", summary_of(GetParam(), figures, limits));
  for (const SequenceVerdict& verdict : judge_figures(figures, limits)) {
    EXPECT_TRUE(verdict.passed) << verdict.what << ": " << verdict.value << ", limit " << verdict.limit;
  }
}

INSTANTIATE_TEST_SUITE_P(Recorded, Topology,
                         testing::Values("two_drops", "melting_bunny", "splitting_armadillo", "falling_objects"),
                         [](const testing::TestParamInfo<std::string>& tested) { return tested.param; });

}  // namespace particle_surface_tracker::test
