#include "stages/nodes/node_masks.h"

#include <random>
#include <set>

#include <gtest/gtest.h>

namespace particle_surface_tracker {
namespace {

using openvdb::Coord;

std::set<Coord> to_set(const NodeMasks& masks) {
  std::set<Coord> nodes;
  for (const NodeMasks::Leaf& leaf : masks.leaves()) {
    for (int x = 0; x < 8; ++x) {
      for_each_bit(leaf.words[x], [&](int bit) { nodes.insert(leaf.origin.offsetBy(x, bit >> 3, bit & 7)); });
    }
  }
  return nodes;
}

std::set<Coord> dilated(const std::set<Coord>& nodes, int down, int up) {
  std::set<Coord> all;
  for (const Coord& node : nodes) {
    for (int x = -down; x <= up; ++x) {
      for (int y = -down; y <= up; ++y) {
        for (int z = -down; z <= up; ++z) all.insert(node.offsetBy(x, y, z));
      }
    }
  }
  return all;
}

TEST(NodeMasks, HoldWhatWasInserted) {
  NodeMasks masks;
  const std::set<Coord> nodes = {{0, 0, 0}, {7, 7, 7}, {8, 7, 7}, {-1, -8, -9}, {1 << 28, -(1 << 28), 3}};
  for (const Coord& node : nodes) masks.insert(node);
  EXPECT_EQ(to_set(masks), nodes);
  EXPECT_TRUE(masks.contains({-1, -8, -9}));
  EXPECT_FALSE(masks.contains({-1, -8, -8}));
}

TEST(NodeMasks, DilatedByEveryWidthHoldTheBoxesAroundTheNodes) {
  constexpr unsigned seed = 7;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> coordinate(-10, 10);
  for (int down = 0; down <= 19; down += 1 + down / 4) {
    for (const int up : {0, 1, 2, 7, 8, 9, 17}) {
      std::set<Coord> nodes;
      for (int n = 0; n < 3; ++n) nodes.insert({coordinate(random), coordinate(random), coordinate(random)});
      NodeMasks masks;
      for (const Coord& node : nodes) masks.insert(node);
      masks.dilate(down, up);
      ASSERT_EQ(to_set(masks), dilated(nodes, down, up)) << "down " << down << ", up " << up;
    }
  }
}

TEST(NodeMasks, NodesBesideAreThoseAtTheEndsOfLatticeEdges) {
  constexpr unsigned seed = 13;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> coordinate(-9, 9);
  NodeMasks masks;
  std::set<Coord> beside;
  for (int n = 0; n < 200; ++n) {
    const Coord node(coordinate(random), coordinate(random), coordinate(random));
    masks.insert(node);
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        Coord neighbor = node;
        neighbor[axis] += step;
        beside.insert(neighbor);
      }
    }
  }
  EXPECT_EQ(to_set(nodes_beside(masks)), beside);
}

TEST(MovedWords, SplitAMaskBetweenTheLeafAndTheNextOne) {
  constexpr unsigned seed = 11;
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  LeafWords words;
  for (std::uint64_t& word : words) word = random();
  for (int axis = 0; axis < 3; ++axis) {
    for (const int direction : {-1, 1}) {
      for (int distance = 1; distance <= 8; ++distance) {
        LeafWords inside{}, outside{};
        for (int x = 0; x < 8; ++x) {
          for_each_bit(words[x], [&](int bit) {
            Coord node(x, bit >> 3, bit & 7);
            node[axis] += direction * distance;
            LeafWords& to = node[axis] < 0 || node[axis] > 7 ? outside : inside;
            to[node.x() & 7] |= std::uint64_t{1} << (8 * (node.y() & 7) + (node.z() & 7));
          });
        }
        const MovedWords moved = move_words(words, axis, direction, distance);
        EXPECT_EQ(moved.inside, inside) << axis << ' ' << direction << ' ' << distance;
        EXPECT_EQ(moved.outside, outside) << axis << ' ' << direction << ' ' << distance;
      }
    }
  }
}

}  // namespace
}  // namespace particle_surface_tracker
