#include "stages/upkeep/packed_box.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace particle_surface_tracker {
namespace {

using Box = Eigen::AlignedBox3f;
using Vec = Eigen::Vector3f;

bool meet(const Box& a, const Box& b) {
  return BoxQuery(a).meets(PackedBox(b));
}

TEST(PackedBox, BoxesThatTouchMeet) {
  const Box unit(Vec(0, 0, 0), Vec(1, 1, 1));
  const float above = std::nextafter(1.0F, 2.0F), below = -std::numeric_limits<float>::denorm_min();
  for (int axis = 0; axis < 3; ++axis) {
    Vec from = Vec::Constant(0.25F), to = Vec::Constant(0.75F);
    from[axis] = 1.0F;
    to[axis] = 2.0F;
    EXPECT_TRUE(meet(unit, Box(from, to))) << axis;
    EXPECT_TRUE(meet(Box(from, to), unit)) << axis;
    from[axis] = above;
    EXPECT_FALSE(meet(unit, Box(from, to))) << axis;
    EXPECT_FALSE(meet(Box(from, to), unit)) << axis;
    from[axis] = -1.0F;
    to[axis] = 0.0F;
    EXPECT_TRUE(meet(unit, Box(from, to))) << axis;
    to[axis] = below;
    EXPECT_FALSE(meet(unit, Box(from, to))) << axis;
  }
}

TEST(PackedBox, AgreesWithEigenOnRandomBoxes) {
  std::mt19937 random(20171);
  std::uniform_int_distribution<int> coordinate(-4, 4);
  int meetings = 0;
  for (int n = 0; n < 20000; ++n) {
    Box boxes[2];
    for (Box& box : boxes) {
      for (int corner = 0; corner < 2; ++corner) {
        // Few different numbers, so that many boxes touch.
        box.extend(1e6F * Eigen::Vector3i(coordinate(random), coordinate(random), coordinate(random)).cast<float>());
      }
    }
    ASSERT_EQ(meet(boxes[0], boxes[1]), boxes[0].intersects(boxes[1]));
    meetings += boxes[0].intersects(boxes[1]) ? 1 : 0;
  }
  EXPECT_GT(meetings, 5000);
  EXPECT_LT(meetings, 15000);
}

}  // namespace
}  // namespace particle_surface_tracker
