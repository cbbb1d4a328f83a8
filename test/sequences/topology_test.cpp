// The tracker on whole recorded sequences in which liquid splits and merges.

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sequences/judged_tracking.h"

namespace particle_surface_tracker::test {

namespace {

class Topology : public testing::TestWithParam<std::string> {};

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
