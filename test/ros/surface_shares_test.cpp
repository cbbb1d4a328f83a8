#include "ros/surface/surface_shares.h"

#include <gtest/gtest.h>

namespace particle_surface_tracker::test {
namespace {

constexpr SurfaceShare kEven{2, 0};
constexpr SurfaceShare kOdd{2, 1};

TEST(SurfaceShares, NobodyIsWaitedForTwiceInVain) {
  SurfaceShares shares;
  EXPECT_TRUE(shares.worth_waiting(7));
  shares.note_missed(7);
  EXPECT_FALSE(shares.worth_waiting(8));
  shares.note(kEven, /*in_time*/ true);
  EXPECT_TRUE(shares.worth_waiting(8));
  EXPECT_FALSE(shares.worth_waiting(9));
}

TEST(SurfaceShares, OnlyWhoHasMissedIsNotTrusted) {
  SurfaceShares shares;
  shares.note(kEven, true);
  shares.note(kOdd, true);
  shares.note_missed(11);
  EXPECT_TRUE(shares.worth_waiting(12));
  EXPECT_FALSE(shares.worth_waiting(13));
  // What comes too late helps nobody.
  shares.note(kOdd, false);
  EXPECT_FALSE(shares.worth_waiting(13));
  shares.note(kOdd, true);
  EXPECT_TRUE(shares.worth_waiting(13));
}

TEST(SurfaceShares, OneOfTwoWithTheSameShareIsEnough) {
  SurfaceShares shares;
  shares.note({1, 0}, true);
  shares.note(kOdd, true);
  shares.note_missed(4);
  EXPECT_FALSE(shares.worth_waiting(4));
  EXPECT_TRUE(shares.worth_waiting(5));
}

TEST(SurfaceShares, WhereNobodyCountsAnyoneWillDo) {
  SurfaceShares shares;
  shares.note(kOdd, true);
  EXPECT_TRUE(shares.worth_waiting(0));
  shares.note_missed(0);
  EXPECT_FALSE(shares.worth_waiting(0));
}

TEST(SurfaceShares, SharesThatMakeNoSenseStandForAllFrames) {
  SurfaceShares shares;
  shares.note({0, 0}, true);
  shares.note({2, 5}, true);
  EXPECT_TRUE(shares.worth_waiting(3));
  EXPECT_TRUE(shares.worth_waiting(4));
}

}  // namespace
}  // namespace particle_surface_tracker::test
