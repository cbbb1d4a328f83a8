#include "tracker/long_step.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "support/parameters.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

constexpr double r = 0.1;

/// Particles that all move by the same number of r, but for some that are faster.
ParticleMotion motion_of(std::size_t count, double way, std::size_t fast, double fast_way) {
  ParticleMotion motion;
  for (std::size_t n = 0; n < count; ++n) {
    motion.positions.push_back(Vec3f(static_cast<float>(n), 0, 0));
    motion.displacements.push_back(Vec3f(0, static_cast<float>(r * (n < fast ? fast_way : way)), 0));
  }
  return motion;
}

TEST(LongStep, HasAStepForEveryFrame) {
  const ParticleMotion motion = motion_of(1000, 1.0, 0, 0.0);
  for (const std::uint64_t elapsed : {1, 2, 4, 16}) {
    EXPECT_EQ(steps_for(motion, elapsed, test::parameters_with_spacing(r)), static_cast<int>(elapsed));
  }
  EXPECT_EQ(steps_for(motion, 1000000, test::parameters_with_spacing(r)), 16);
}

TEST(LongStep, HasMoreStepsWhereTheWayIsLong) {
  EXPECT_EQ(steps_for(motion_of(1000, 3.9, 0, 0.0), 1, test::parameters_with_spacing(r)), 1);
  EXPECT_EQ(steps_for(motion_of(1000, 9.0, 0, 0.0), 1, test::parameters_with_spacing(r)), 3);
  EXPECT_EQ(steps_for(motion_of(1000, 9.0, 0, 0.0), 5, test::parameters_with_spacing(r)), 5);
  EXPECT_EQ(steps_for(motion_of(1000, 1e6, 0, 0.0), 1, test::parameters_with_spacing(r)), 16);
  // A few drops are no reason.
  EXPECT_EQ(steps_for(motion_of(1000, 1.0, 10, 9.0), 1, test::parameters_with_spacing(r)), 1);
  EXPECT_EQ(steps_for(motion_of(1000, 1.0, 11, 9.0), 1, test::parameters_with_spacing(r)), 3);
  EXPECT_EQ(steps_for(motion_of(3, 9.0, 0, 0.0), 1, test::parameters_with_spacing(r)), 3);
  EXPECT_EQ(steps_for(ParticleMotion(), 7, test::parameters_with_spacing(r)), 1);
}

struct Turn {
  explicit Turn(double angle) {
    const ParticleFrame ball = test::fill_with_particles(Vec3d::Constant(-1.0), Vec3d::Constant(1.0), r, 0.2, 9,
                                                         [](const Vec3d& x) { return x.norm() < 1.0; });
    const Eigen::AngleAxisd turn(angle, Vec3d(1, -2, 0.5).normalized());
    motion.positions = ball.positions;
    for (const Vec3f& x : ball.positions) {
      motion.displacements.push_back((turn * x.cast<double>() - x.cast<double>()).cast<float>());
    }
    vertices = test::make_sphere(Vec3d::Zero(), 1.0, 4).positions();
    for (const Vec3f& x : vertices) turned.push_back((turn * x.cast<double>()).cast<float>());
  }

  ParticleMotion motion;
  std::vector<Vec3f> vertices;
  std::vector<Vec3f> turned;
};

TEST(LongStep, OneStepIsAdvection) {
  const Turn turn(0.1);
  EXPECT_EQ(
      advect_in_steps(turn.vertices, turn.motion, 1, test::parameters_with_spacing(r)),
      advect(turn.vertices, turn.motion, ParticleGrid(turn.motion.positions, r), test::parameters_with_spacing(r)));
}

TEST(LongStep, RigidMotionStaysExact) {
  const Turn turn(0.5);
  for (const int steps : {1, 4, 16}) {
    const std::vector<Vec3f> advected =
        advect_in_steps(turn.vertices, turn.motion, steps, test::parameters_with_spacing(r));
    double largest = 0.0;
    for (std::size_t v = 0; v < advected.size(); ++v) {
      largest = std::max(largest, static_cast<double>((advected[v] - turn.turned[v]).norm()));
    }
    EXPECT_LT(largest, 0.01 * r) << steps;
  }
}

}  // namespace
}  // namespace particle_surface_tracker
