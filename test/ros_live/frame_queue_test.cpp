#include "ros/live/frame_queue.h"

#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <boost/make_shared.hpp>

namespace particle_surface_tracker {
namespace {

ReceivedFrame frame(std::uint32_t number, Reception reception = Reception::kUsable) {
  ReceivedFrame received;
  received.header.seq = number;
  received.header.stamp = ros::Time(1000 + number, 0);
  received.reception = reception;
  if (reception == Reception::kUsable) received.cloud = boost::make_shared<const sensor_msgs::PointCloud2>();
  return received;
}

FrameQueue::Time now() {
  return std::chrono::steady_clock::now();
}

TEST(FrameQueue, KeepsTheOrderAndDropsWhatArrivesWhenItIsFull) {
  FrameQueue queue(2, QueuePolicy::kAll);
  for (std::uint32_t n = 0; n < 4; ++n) queue.push(frame(n));
  EXPECT_EQ(queue.size(), 2u);
  for (std::uint32_t n = 0; n < 4; ++n) {
    const auto received = queue.pop(now());
    ASSERT_TRUE(received);
    EXPECT_EQ(received->header.seq, n);
    EXPECT_EQ(received->reception, n < 2 ? Reception::kUsable : Reception::kDropped);
    EXPECT_EQ(received->cloud != nullptr, n < 2);
    EXPECT_EQ(received->reason.empty(), n < 2);
  }
  EXPECT_EQ(queue.size(), 0u);
  queue.push(frame(4));
  EXPECT_EQ(queue.pop(now())->reception, Reception::kUsable);
}

TEST(FrameQueue, FramesWithoutACloudTakeNoPlace) {
  FrameQueue queue(1, QueuePolicy::kAll);
  queue.push(frame(0, Reception::kInvalid));
  queue.push(frame(1));
  EXPECT_EQ(queue.pop(now())->reception, Reception::kInvalid);
  EXPECT_EQ(queue.pop(now())->reception, Reception::kUsable);
}

std::vector<Reception> receptions(FrameQueue& queue) {
  std::vector<Reception> all;
  while (const auto received = queue.pop(now())) {
    EXPECT_EQ(received->cloud != nullptr, received->reception == Reception::kUsable);
    all.push_back(received->reception);
  }
  return all;
}

TEST(FrameQueue, LatestReplacesWhatWaits) {
  FrameQueue queue(1, QueuePolicy::kLatest);
  queue.push(frame(0));
  EXPECT_EQ(queue.pop(now())->reception, Reception::kUsable);
  queue.push(frame(1, Reception::kInvalid));
  for (std::uint32_t n = 2; n < 5; ++n) queue.push(frame(n));
  EXPECT_EQ(queue.size(), 1u);
  const std::vector<Reception> wanted = {Reception::kInvalid, Reception::kReplaced, Reception::kReplaced,
                                         Reception::kUsable};
  EXPECT_EQ(receptions(queue), wanted);
  EXPECT_EQ(queue.size(), 0u);
}

// The mesh belongs to the first frame, which must not be skipped where the next ones arrive before the worker wakes.
TEST(FrameQueue, LatestKeepsTheFirstFrameOfARun) {
  FrameQueue queue(1, QueuePolicy::kLatest);
  queue.push(frame(0, Reception::kInvalid));
  for (std::uint32_t n = 1; n < 4; ++n) queue.push(frame(n));
  EXPECT_EQ(queue.size(), 2u);
  const std::vector<Reception> wanted = {Reception::kInvalid, Reception::kUsable, Reception::kReplaced,
                                         Reception::kUsable};
  EXPECT_EQ(receptions(queue), wanted);
  EXPECT_EQ(queue.size(), 0u);
}

TEST(FrameQueue, LatestGoesOnToTheNewestRun) {
  FrameQueue queue(1, QueuePolicy::kLatest);
  for (int loop = 0; loop < 3; ++loop) {
    for (std::uint32_t n = 0; n < 3; ++n) queue.push(frame(n));
  }
  ReceivedFrame other = frame(7);
  other.header.frame_id = "basin";
  queue.push(other);
  queue.push(frame(8));
  // Of all that waits nothing is left but the frame that began the last run, which is also the newest.
  EXPECT_EQ(queue.size(), 1u);
  std::vector<Reception> wanted(10, Reception::kReplaced);
  wanted.push_back(Reception::kUsable);
  EXPECT_EQ(receptions(queue), wanted);
}

TEST(FrameQueue, CommandsGoFirst) {
  FrameQueue queue(5, QueuePolicy::kAll);
  queue.push(frame(0));
  int runs = 0;
  queue.push(FrameQueue::Command([&runs] { ++runs; }));
  queue.push(FrameQueue::Command([&runs] { ++runs; }));
  EXPECT_EQ(queue.pop(now())->header.seq, 0u);
  EXPECT_EQ(runs, 2);
}

TEST(FrameQueue, HeldFramesWaitAndCommandsRun) {
  FrameQueue queue(2, QueuePolicy::kAll);
  queue.hold(true);
  queue.push(frame(0, Reception::kInvalid));
  for (std::uint32_t n = 1; n < 4; ++n) queue.push(frame(n));
  int runs = 0;
  queue.push(FrameQueue::Command([&runs] { ++runs; }));
  // What is lost is answered at once, also from behind what waits.
  const std::vector<Reception> lost = {Reception::kInvalid, Reception::kDropped};
  EXPECT_EQ(receptions(queue), lost);
  EXPECT_EQ(runs, 1);
  EXPECT_EQ(queue.size(), 2u);
  queue.hold(false);
  const std::vector<Reception> wanted = {Reception::kUsable, Reception::kUsable};
  EXPECT_EQ(receptions(queue), wanted);
}

TEST(FrameQueue, WhatGoesAheadKnowsItsPlace) {
  FrameQueue queue(2, QueuePolicy::kAll);
  queue.push(frame(0, Reception::kInvalid));
  queue.push(frame(1));
  queue.push(frame(2, Reception::kInvalid));
  queue.hold(true);
  for (std::uint32_t n = 3; n < 5; ++n) queue.push(frame(n));
  for (const std::uint32_t n : {0u, 2u, 4u}) {
    const auto received = queue.pop(now());
    ASSERT_TRUE(received);
    EXPECT_EQ(received->header.seq, n);
    EXPECT_EQ(received->number, n + 1);
    EXPECT_EQ(received->is_ahead, n > 0) << n;
  }
  EXPECT_FALSE(queue.pop(now()));
  queue.hold(false);
  for (const std::uint32_t n : {1u, 3u}) {
    const auto received = queue.pop(now());
    ASSERT_TRUE(received);
    EXPECT_EQ(received->number, n + 1);
    EXPECT_FALSE(received->is_ahead);
  }
}

TEST(FrameQueue, StrictDropsWhatArrivesWhenItIsFull) {
  FrameQueue queue(1, QueuePolicy::kStrict);
  for (std::uint32_t n = 0; n < 3; ++n) queue.push(frame(n));
  const std::vector<Reception> wanted = {Reception::kUsable, Reception::kDropped, Reception::kDropped};
  EXPECT_EQ(receptions(queue), wanted);
}

TEST(FrameQueue, GivesUpWhenItsTimeIsOver) {
  FrameQueue queue(1, QueuePolicy::kAll);
  EXPECT_FALSE(queue.pop(now() + std::chrono::milliseconds(2)));
  EXPECT_FALSE(queue.closed());
}

TEST(FrameQueue, ClosingEndsTheWaiting) {
  FrameQueue queue(1, QueuePolicy::kAll);
  std::thread waiting([&queue] { EXPECT_FALSE(queue.pop(std::nullopt)); });
  queue.close();
  waiting.join();
  queue.push(frame(0));
  EXPECT_FALSE(queue.pop(std::nullopt));
  EXPECT_TRUE(queue.closed());
}

}  // namespace
}  // namespace particle_surface_tracker
