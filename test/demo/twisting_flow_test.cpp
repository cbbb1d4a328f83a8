#include "twisting_flow.h"

#include <cmath>

#include <gtest/gtest.h>

namespace particle_surface_tracker::demo {
namespace {

const Vec3d points[] = {{0.0, 0.0, 0.0}, {0.5, 0.0, 0.2}, {-0.3, 0.6, -0.1}, {0.1, -0.7, 0.2}};

double divergence(const TwistingFlow& flow, const Vec3d& at, double time) {
  const double h = 1e-4;
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3d step = h * Vec3d::Unit(axis);
    sum += (flow.velocity(at + step, time) - flow.velocity(at - step, time))[axis] / (2.0 * h);
  }
  return sum;
}

TEST(TwistingFlow, HasNoDivergence) {
  for (const Vec3d& point : points) EXPECT_NEAR(divergence(TwistingFlow(), point, 0.4), 0.0, 1e-9);
}

TEST(TwistingFlow, StartsAndEndsAtRest) {
  for (const Vec3d& point : points) {
    EXPECT_NEAR(TwistingFlow().velocity(point, 0.0).norm(), 0.0, 1e-15);
    EXPECT_NEAR(TwistingFlow().velocity(point, 1.0).norm(), 0.0, 1e-15);
  }
  EXPECT_GT(TwistingFlow().velocity(points[1], 0.5).norm(), 0.3);
}

TEST(TwistingFlow, FollowingBackwardsReturns) {
  const TwistingFlow flow;
  for (const Vec3d& point : points) {
    const Vec3d moved = flow.follow(point, 0.0, 0.7, 100);
    EXPECT_NEAR((flow.follow(moved, 0.7, -0.7, 100) - point).norm(), 0.0, 1e-8);
  }
}

TEST(TwistingFlow, FollowingIsOfFourthOrder) {
  const TwistingFlow flow;
  const Vec3d exact = flow.follow(points[2], 0.0, 1.0, 4000);
  const double coarse = (flow.follow(points[2], 0.0, 1.0, 20) - exact).norm();
  const double fine = (flow.follow(points[2], 0.0, 1.0, 40) - exact).norm();
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.5);
}

}  // namespace
}  // namespace particle_surface_tracker::demo
