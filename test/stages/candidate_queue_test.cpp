// The order in which mesh upkeep deals with candidates.
#include "stages/upkeep/candidate_queue.h"

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace particle_surface_tracker {
namespace {

constexpr double kTile = 0.5;

Candidate make_candidate(Ailment ailment, double urgency, std::uint32_t number) {
  return {ailment, urgency, number, number + 1, 3 * number};
}

std::vector<std::uint32_t> take_all(CandidateQueue& queue) {
  std::vector<std::uint32_t> numbers;
  while (!queue.empty()) numbers.push_back(queue.take().low);
  return numbers;
}

TEST(CandidateQueue, AilmentsComeFirstThenTilesThenUrgency) {
  CandidateQueue queue(kTile);
  const Vec3f here(0.1F, 0.1F, 0.1F), also_here(0.2F, -0.2F, 0.2F), beside(0.1F, 0.3F, 0.1F), before(-0.3F, 0.9F, 0.9F);
  queue.push(make_candidate(Ailment::kSliver, 9.0, 0), before);
  queue.push(make_candidate(Ailment::kShortEdge, 9.0, 1), beside);
  queue.push(make_candidate(Ailment::kShortEdge, 1.0, 2), here);
  queue.push(make_candidate(Ailment::kShortEdge, 2.0, 3), also_here);
  queue.push(make_candidate(Ailment::kShortEdge, 0.5, 4), before);
  queue.push(make_candidate(Ailment::kLongEdge, 0.1, 5), beside);
  EXPECT_EQ(queue.next_ailment(), Ailment::kLongEdge);
  EXPECT_EQ(take_all(queue), (std::vector<std::uint32_t>{5, 4, 3, 2, 1, 0}));
}

TEST(CandidateQueue, OfLongEdgesTheMostUrgentComesFirstEverywhere) {
  CandidateQueue queue(kTile);
  queue.push(make_candidate(Ailment::kLongEdge, 1.0, 1), Vec3f(-0.1F, 0.0F, 0.0F));
  queue.push(make_candidate(Ailment::kLongEdge, 2.0, 2), Vec3f(0.1F, 0.0F, 0.0F));
  queue.push(make_candidate(Ailment::kLongEdge, 3.0, 3), Vec3f(0.6F, 0.0F, 0.0F));
  EXPECT_EQ(take_all(queue), (std::vector<std::uint32_t>{3, 2, 1}));
}

TEST(CandidateQueue, ATieGoesToTheLowerVertices) {
  CandidateQueue queue(kTile);
  for (const std::uint32_t number : {7U, 3U, 5U}) {
    queue.push(make_candidate(Ailment::kFoldedEdge, 1.0, number), Vec3f::Zero());
  }
  EXPECT_EQ(take_all(queue), (std::vector<std::uint32_t>{3, 5, 7}));
}

TEST(CandidateQueue, WhatIsPushedTwiceIsTakenOnce) {
  CandidateQueue queue(kTile);
  for (int n = 0; n < 3; ++n) queue.push(make_candidate(Ailment::kShortEdge, 1.0, 4), Vec3f::Zero());
  queue.push(make_candidate(Ailment::kShortEdge, 0.5, 5), Vec3f::Zero());
  EXPECT_EQ(take_all(queue), (std::vector<std::uint32_t>{4, 5}));
  queue.push(make_candidate(Ailment::kShortEdge, 1.0, 4), Vec3f::Zero());
  EXPECT_EQ(take_all(queue), (std::vector<std::uint32_t>{4}));
}

TEST(CandidateQueue, WhatIsPushedForATileThatIsDoneComesNext) {
  CandidateQueue queue(kTile);
  const Vec3f first(0.1F, 0.1F, 0.1F), second(0.6F, 0.1F, 0.1F);
  queue.push(make_candidate(Ailment::kShortEdge, 1.0, 1), first);
  queue.push(make_candidate(Ailment::kShortEdge, 1.0, 2), second);
  queue.push(make_candidate(Ailment::kShortEdge, 0.5, 3), second);
  EXPECT_EQ(queue.take().low, 1U);
  EXPECT_EQ(queue.take().low, 2U);
  queue.push(make_candidate(Ailment::kShortEdge, 0.1, 4), first);
  EXPECT_EQ(take_all(queue), (std::vector<std::uint32_t>{4, 3}));
}

TEST(CandidateQueue, TheOrderOfPushesDoesNotMatter) {
  const std::uint32_t seed = std::random_device{}();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> coordinate(-1.0F, 1.0F);
  std::uniform_int_distribution<int> small(0, 3);
  std::vector<std::pair<Candidate, Vec3f>> all;
  for (std::uint32_t n = 0; n < 500; ++n) {
    // Few urgencies, so that there are ties.
    all.push_back({make_candidate(static_cast<Ailment>(small(random)), small(random), n),
                   Vec3f(coordinate(random), coordinate(random), coordinate(random))});
  }
  const auto order = [&] {
    CandidateQueue queue(kTile);
    for (const auto& [candidate, place] : all) queue.push(candidate, place);
    return take_all(queue);
  };
  const std::vector<std::uint32_t> expected = order();
  EXPECT_EQ(expected.size(), all.size());
  std::shuffle(all.begin(), all.end(), random);
  EXPECT_EQ(order(), expected);
}

}  // namespace
}  // namespace particle_surface_tracker
