// The tracker on liquids that are made to be hard to follow.

#include "sequences/moving_liquids.h"

#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "sequences/judged_tracking.h"

namespace particle_surface_tracker::test {

namespace {

class MovingLiquid : public testing::TestWithParam<std::string> {};

}  // namespace

TEST_P(MovingLiquid, IsFollowed) {
  const std::vector<TopologyFigures> figures = track_and_judge(make_moving_liquid(GetParam()));
  const SequenceLimits limits = limits_for(GetParam());
  fmt::print("{}", summary_of(GetParam(), figures, limits));
  for (const SequenceVerdict& verdict : judge_figures(figures, limits)) {
    EXPECT_TRUE(verdict.passed) << verdict.what << ": " << verdict.value << ", limit " << verdict.limit;
  }
}

INSTANTIATE_TEST_SUITE_P(Made, MovingLiquid, testing::ValuesIn(moving_liquid_names()),
                         [](const testing::TestParamInfo<std::string>& tested) { return tested.param; });

TEST(MovingLiquids, AreTheSameEveryTime) {
  const Sequence one = make_moving_liquid("rain"), other = make_moving_liquid("rain");
  ASSERT_EQ(one.frames.size(), other.frames.size());
  for (std::size_t n = 0; n < one.frames.size(); ++n) {
    EXPECT_EQ(one.frames[n].positions, other.frames[n].positions) << n;
    EXPECT_EQ(one.frames[n].ids, other.frames[n].ids) << n;
  }
  EXPECT_EQ(one.mesh.positions(), other.mesh.positions());
}

TEST(MovingLiquids, ANameThatIsNotKnownIsAnError) {
  EXPECT_THROW(make_moving_liquid("lava"), std::invalid_argument);
}

}  // namespace particle_surface_tracker::test
