// What track_bag says of all frames of a run together, and what it goes by.

#include "ros/run_facts.h"

#include <limits>
#include <sstream>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "ros/run_input.h"
#include "ros/run_messages.h"

namespace particle_surface_tracker::test {
namespace {

FrameReport report_of(std::uint64_t frame, std::int64_t milliseconds) {
  FrameReport report;
  report.frame = frame;
  report.stamp_ns = 1000000000000 + milliseconds * 1000000;
  return report;
}

std::string text_of(const RunFacts& facts) {
  std::ostringstream out;
  facts.print(out);
  return out.str();
}

TEST(RunFacts, AreSumsAndExtremes) {
  RunFacts facts;
  EXPECT_EQ(text_of(facts), "");
  FrameReport report = report_of(7, 0);
  report.total_time = 0.5;
  report.smallest_angle = 20.0;
  facts.note(report);
  report = report_of(8, 40);
  report.total_time = 2.25;
  report.smallest_angle = 3.125;
  report.missing_frames = 2;
  report.topology.splits = 2;
  report.topology.merges = 1;
  report.topology.remeshed_cells = 50;
  facts.note(report);
  report = report_of(9, 80);
  report.missing_frames = 1;
  report.topology.splits = 1;
  report.topology.gone = 4;
  facts.note(report);
  EXPECT_EQ(text_of(facts),
            "pieces: 3 split off, 1 merged, 4 gone; 50 re-meshed cells\n"
            "smallest angle of a triangle: 3.12 deg, in frame 8\n"
            "longest frame: 8, 2.250 s\n"
            "3 frames are missing in the bag, in 2 gaps\n");
}

TEST(RunFacts, RealTimeIsThatOfTheStamps) {
  RunFacts facts;
  EXPECT_FALSE(facts.real_time_factor(1.0));
  facts.note(report_of(0, 0));
  EXPECT_FALSE(facts.real_time_factor(1.0));
  facts.note(report_of(1, 500));
  EXPECT_NEAR(facts.real_time_factor(2.0).value(), 0.25, 1e-9);
  facts.note(report_of(2, -500));
  EXPECT_FALSE(facts.real_time_factor(1.0));
  FrameReport damaged;
  damaged.stamp_ns = std::numeric_limits<std::int64_t>::max();
  facts.note(damaged);
  EXPECT_GT(facts.real_time_factor(1.0).value(), 1e9);
}

TEST(RunMessages, TheLineOfProgressHasRealTimeWhereItIsKnown) {
  std::ostringstream err;
  RunMessages messages(err, /*warnings*/ true, /*progress*/ true);
  messages.show_progress(1, 10, 20, std::nullopt);
  EXPECT_NE(err.str().find("frame 20: 1/10, "), std::string::npos) << err.str();
  EXPECT_NE(err.str().find(" left"), std::string::npos) << err.str();
  EXPECT_EQ(err.str().find("real time"), std::string::npos) << err.str();
  messages.show_progress(2, 10, 21, 0.034);
  EXPECT_NE(err.str().find("frames/s, 0.034 x real time, "), std::string::npos) << err.str();
}

TEST(RunMessages, WhatIsTrueOfEveryFrameIsSaidOnce) {
  std::ostringstream err;
  RunMessages messages(err, /*warnings*/ true, /*progress*/ false);
  messages.warn_once(3, "it has no velocity");
  messages.warn_once(4, "it has no velocity");
  EXPECT_EQ(err.str(), "track_bag: warning: frame 3: it has no velocity; not said again\n");
}

std_msgs::Header header(int milliseconds, std::uint32_t number = 0) {
  std_msgs::Header result;
  result.stamp = ros::Time(1000, 0) + ros::Duration(0, milliseconds * 1000000);
  result.seq = number;
  return result;
}

TEST(RunInput, GoesOnFromACheckpointWithTheSameJudgements) {
  RunInput whole, first;
  FrameReport report;
  for (const int time : {0, 10, 20, 30, 40}) {
    EXPECT_EQ(whole.judge(header(time), report), "");
    first.judge(header(time), report);
  }
  Checkpoint checkpoint;
  first.save(checkpoint);
  RunInput second;
  second.load(checkpoint);
  for (RunInput* input : {&whole, &second}) {
    FrameReport next;
    EXPECT_EQ(input->judge(header(80), next), "");
    EXPECT_EQ(next.missing_frames, 3u);
    ASSERT_EQ(next.warnings.size(), 1u);
    EXPECT_EQ(next.warnings[0], "3 frames are missing before it");
    EXPECT_NE(input->judge(header(80), next), "");
    EXPECT_EQ(next.missing_frames, 0u);
  }
  checkpoint.sections["track_bag_input"].pop_back();
  EXPECT_THROW(second.load(checkpoint), InputError);
  EXPECT_NO_THROW(second.load(Checkpoint()));
}

}  // namespace
}  // namespace particle_surface_tracker::test
