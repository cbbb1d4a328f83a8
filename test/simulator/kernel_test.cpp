#include "kernel.h"

#include <cmath>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/types.h"
#include "wall_profile.h"

namespace particle_surface_tracker::simulator {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kRadius = 0.05;

// Calls visit(position, volume) for the cells of a fine grid around the origin that fills the kernel's support.
template <class Visit>
void for_each_cell(double step, const Visit& visit) {
  const int reach = static_cast<int>(std::ceil(kRadius / step));
  for (int i = -reach; i < reach; ++i) {
    for (int j = -reach; j < reach; ++j) {
      for (int k = -reach; k < reach; ++k) {
        visit(Vec3d(step * Vec3d(i + 0.5, j + 0.5, k + 0.5)), step * step * step);
      }
    }
  }
}

TEST(Kernel, IntegratesToOne) {
  const Kernel kernel(kRadius);
  double sum = 0.0;
  const int steps = 10000;
  for (int n = 0; n < steps; ++n) {
    const double s = (n + 0.5) * kRadius / steps;
    sum += kernel.value(s) * 4.0 * kPi * s * s * kRadius / steps;
  }
  EXPECT_NEAR(sum, 1.0, 1e-6);
}

TEST(Kernel, SlopeIsTheDerivativeOverTheDistance) {
  const Kernel kernel(kRadius);
  const double step = 1e-6 * kRadius;
  for (const double q : {0.01, 0.2, 0.49, 0.51, 0.8, 0.99}) {
    const double s = q * kRadius;
    const double derivative = (kernel.value(s + step) - kernel.value(s - step)) / (2.0 * step);
    EXPECT_NEAR(kernel.slope(s) * s, derivative, 1e-7 * kernel.value(0.0) / kRadius) << q;
  }
}

TEST(Kernel, GradientPointsToTheOtherParticle) {
  const Kernel kernel(kRadius);
  const Vec3d offset(0.011, -0.017, 0.006);
  const double step = 1e-7;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3d moved = step * Vec3d::Unit(axis);
    const double derivative =
        (kernel.value((offset + moved).norm()) - kernel.value((offset - moved).norm())) / (2 * step);
    EXPECT_NEAR(kernel.slope(offset.norm()) * offset[axis], derivative, 1e-5 * std::abs(derivative));
  }
}

TEST(Kernel, EndsAtItsRadius) {
  const Kernel kernel(kRadius);
  EXPECT_EQ(kernel.value(kRadius), 0.0);
  EXPECT_EQ(kernel.slope(kRadius), 0.0);
  EXPECT_EQ(kernel.value(2.0 * kRadius), 0.0);
  EXPECT_GT(kernel.value(0.999 * kRadius), 0.0);
  EXPECT_TRUE(std::isfinite(kernel.slope(0.0)));
}

TEST(Kernel, VolumeOnAGridIsThatOfACell) {
  const double spacing = 0.5 * kRadius;
  EXPECT_NEAR(volume_on_grid(Kernel(kRadius), spacing) / std::pow(spacing, 3), 1.0, 1e-3);
  EXPECT_NEAR(volume_on_grid(Kernel(kRadius), 0.1 * kRadius) / std::pow(0.1 * kRadius, 3), 1.0, 1e-4);
}

TEST(WallProfile, AWallAtTheParticleIsHalfOfAll) {
  const Kernel kernel(kRadius);
  const WallProfile::Values values = WallProfile(kernel).at(0.0);
  EXPECT_NEAR(values.density, 0.5, 1e-6);
  EXPECT_NEAR(values.normal_drag, values.tangential_drag, 1e-6 * values.normal_drag);
}

TEST(WallProfile, IsNothingBeyondTheKernel) {
  const WallProfile profile{Kernel(kRadius)};
  for (const double distance : {kRadius, 1.5 * kRadius, 1e9}) {
    EXPECT_EQ(profile.at(distance).density, 0.0);
    EXPECT_EQ(profile.at(distance).normal_drag, 0.0);
  }
  EXPECT_EQ(profile.at(-1.0).density, profile.at(0.0).density);
}

TEST(WallProfile, SlopeIsTheDerivative) {
  const WallProfile profile{Kernel(kRadius)};
  const double step = 0.01 * kRadius;
  for (const double q : {0.1, 0.25, 0.5, 0.8}) {
    const double d = q * kRadius;
    const double derivative = (profile.at(d + step).density - profile.at(d - step).density) / (2.0 * step);
    EXPECT_NEAR(profile.at(d).density_slope, derivative, 1e-3 / kRadius) << q;
  }
}

// Sums over small cells of liquid behind the wall, with the formulas of pairs of particles.
TEST(WallProfile, IsThatOfLiquidBehindTheWall) {
  const Kernel kernel(kRadius);
  const WallProfile profile(kernel);
  for (const double d : {0.2 * kRadius, 0.5 * kRadius}) {
    double density = 0.0;
    Eigen::Matrix3d drag = Eigen::Matrix3d::Zero();
    for_each_cell(0.02 * kRadius, [&](const Vec3d& cell, double volume) {
      if (cell.z() > -d) return;
      density += volume * kernel.value(cell.norm());
      drag -= 10.0 * volume * kernel.slope(cell.norm()) / cell.squaredNorm() * cell * cell.transpose();
    });
    EXPECT_NEAR(profile.at(d).density, density, 2e-3);
    EXPECT_NEAR(profile.at(d).normal_drag, drag(2, 2), 0.02 * drag(2, 2));
    EXPECT_NEAR(profile.at(d).tangential_drag, drag(0, 0), 0.02 * drag(0, 0));
  }
}

}  // namespace
}  // namespace particle_surface_tracker::simulator
