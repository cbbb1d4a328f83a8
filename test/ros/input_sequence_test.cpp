#include "ros/input_sequence.h"

#include <gtest/gtest.h>

namespace particle_surface_tracker {
namespace {

using Verdict = InputSequence::Verdict;

// Milliseconds since 1000 s; sources that do not count leave the number at 0.
std_msgs::Header header(int milliseconds, std::uint32_t number = 0, const std::string& frame_id = "tank") {
  std_msgs::Header result;
  result.stamp = ros::Time(1000, 0) + ros::Duration(0, milliseconds * 1000000);
  result.seq = number;
  result.frame_id = frame_id;
  return result;
}

TEST(InputSequence, CountsFrames) {
  InputSequence sequence;
  EXPECT_EQ(sequence.judge(header(0)).verdict, Verdict::kFirst);
  for (int n = 1; n < 5; ++n) {
    const auto judgement = sequence.judge(header(10 * n));
    EXPECT_EQ(judgement.verdict, Verdict::kNext);
    EXPECT_EQ(judgement.index, static_cast<std::uint64_t>(n));
    EXPECT_EQ(judgement.missing, 0u);
  }
  sequence.reset();
  EXPECT_EQ(sequence.judge(header(50)).verdict, Verdict::kFirst);
}

TEST(InputSequence, BeginningAgainIsAReset) {
  InputSequence sequence;
  for (int n = 0; n < 3; ++n) sequence.judge(header(10 * n));
  const auto again = sequence.judge(header(0));
  EXPECT_EQ(again.verdict, Verdict::kWentBack);
  EXPECT_EQ(again.index, 0u);
  EXPECT_EQ(sequence.judge(header(10)).verdict, Verdict::kNext);
  EXPECT_EQ(sequence.judge(header(-20)).verdict, Verdict::kWentBack);
}

TEST(InputSequence, OneRepetitionOfTheFirstFrameIsNoReset) {
  InputSequence sequence;
  sequence.judge(header(0));
  EXPECT_EQ(sequence.judge(header(0)).verdict, Verdict::kRepeated);
}

TEST(InputSequence, SingleLateFramesAreLate) {
  InputSequence sequence;
  for (const int time : {0, 10, 20, 40}) sequence.judge(header(time));
  EXPECT_EQ(sequence.judge(header(30)).verdict, Verdict::kLate);
  EXPECT_EQ(sequence.judge(header(50)).verdict, Verdict::kNext);
  EXPECT_EQ(sequence.judge(header(45)).verdict, Verdict::kLate);
  EXPECT_EQ(sequence.judge(header(44)).verdict, Verdict::kLate);
  EXPECT_EQ(sequence.judge(header(43)).verdict, Verdict::kLate);
  EXPECT_EQ(sequence.judge(header(60)).verdict, Verdict::kNext);
}

TEST(InputSequence, ThirdLateFrameInARowIsANewRun) {
  InputSequence sequence;
  for (int n = 0; n < 10; ++n) sequence.judge(header(10 * n));
  EXPECT_EQ(sequence.judge(header(30)).verdict, Verdict::kLate);
  EXPECT_EQ(sequence.judge(header(40)).verdict, Verdict::kLate);
  EXPECT_EQ(sequence.judge(header(50)).verdict, Verdict::kWentBack);
  EXPECT_EQ(sequence.judge(header(60)).verdict, Verdict::kNext);
}

TEST(InputSequence, OtherFrameIdIsANewRun) {
  InputSequence sequence;
  sequence.judge(header(0));
  EXPECT_EQ(sequence.judge(header(10, 0, "basin")).verdict, Verdict::kOtherFrameId);
  EXPECT_EQ(sequence.judge(header(20, 0, "basin")).verdict, Verdict::kNext);
}

TEST(InputSequence, NumbersTellWhatIsMissing) {
  InputSequence sequence;
  sequence.judge(header(0, 7));
  sequence.judge(header(10, 8));
  // The times are as they like.
  EXPECT_EQ(sequence.judge(header(100, 9)).missing, 0u);
  const auto judgement = sequence.judge(header(101, 13));
  EXPECT_EQ(judgement.missing, 3u);
  EXPECT_EQ(judgement.index, 6u);
}

TEST(InputSequence, WithoutNumbersTheTimesTell) {
  InputSequence sequence;
  for (int n = 0; n < 5; ++n) EXPECT_EQ(sequence.judge(header(10 * n)).missing, 0u);
  EXPECT_EQ(sequence.judge(header(54)).missing, 0u);
  EXPECT_EQ(sequence.judge(header(84)).missing, 2u);
  EXPECT_EQ(sequence.judge(header(94)).missing, 0u);
}

TEST(InputSequence, FramesThatCannotBeUsedAreNotMissing) {
  for (const std::uint32_t step : {0u, 1u}) {
    InputSequence sequence;
    for (std::uint32_t n = 0; n < 5; ++n) sequence.judge(header(10 * static_cast<int>(n), step * n));
    sequence.pass_over();
    sequence.pass_over();
    const auto judgement = sequence.judge(header(70, step * 7));
    EXPECT_EQ(judgement.missing, 0u) << step;
    EXPECT_EQ(judgement.index, 7u) << step;
  }
}

TEST(InputSequence, DamagedStampsDoNotHurt) {
  InputSequence sequence;
  std_msgs::Header damaged = header(0);
  damaged.stamp.sec = 0xffffffffu;
  damaged.stamp.nsec = 0xffffffffu;
  sequence.judge(header(0));
  EXPECT_EQ(sequence.judge(damaged).verdict, Verdict::kNext);
  EXPECT_EQ(sequence.judge(header(10)).verdict, Verdict::kLate);
  EXPECT_EQ(sequence.judge(header(20)).verdict, Verdict::kLate);
  EXPECT_EQ(sequence.judge(header(30)).verdict, Verdict::kWentBack);
}

}  // namespace
}  // namespace particle_surface_tracker
