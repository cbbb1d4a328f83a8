// The tracker where it sees every fourth frame only, as a live node that is too slow does with policy `latest`.

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sequences/judged_tracking.h"

namespace particle_surface_tracker::test {

namespace {

constexpr std::size_t kStep = 4;

class SkippedFrames : public testing::TestWithParam<const char*> {};

}  // namespace

TEST_P(SkippedFrames, EndWithTheTopologyAndVolumeOfTheLiquid) {
  PST_SKIP_WITHOUT(GetParam());
  const std::vector<TopologyFigures> figures = track_and_judge(load_sequence(GetParam()), kStep);
  for (const TopologyFigures& frame : figures) EXPECT_TRUE(frame.is_valid()) << frame.frame;
  const TopologyFigures& last = figures.back();
  EXPECT_EQ(last.topology.wrong, 0u);
  EXPECT_NEAR(last.volume_ratio / figures.front().volume_ratio, 1.0, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Recorded, SkippedFrames, testing::Values("melting_bunny", "splitting_armadillo"),
                         [](const testing::TestParamInfo<const char*>& tested) { return std::string(tested.param); });

}  // namespace particle_surface_tracker::test
