#include "fluid_simulator.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <Eigen/Geometry>

#include "liquid_bodies.h"

namespace particle_surface_tracker::simulator {
namespace {

struct Momentum {
  Vec3d linear = Vec3d::Zero();   // Sum of the velocities [m/s].
  Vec3d angular = Vec3d::Zero();  // [m²/s]
  double speeds = 0.0;            // Sum of the speeds [m/s].
};

Momentum momentum(const ParticleFrame& frame, std::size_t first, std::size_t last) {
  Momentum sum;
  for (std::size_t i = first; i < last; ++i) {
    const Vec3d velocity = frame.velocities[i].cast<double>();
    sum.linear += velocity;
    sum.angular += frame.positions[i].cast<double>().cross(velocity);
    sum.speeds += velocity.norm();
  }
  return sum;
}

bool same_bytes(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3f)) == 0;
}

// A block that falls onto the side of a ball and then onto the floor.
SimulatorParameters ball_in_tank() {
  SimulatorParameters parameters = test_parameters();
  parameters.tank_half_width = 0.35;
  parameters.frame_interval = 1.0 / 30.0;
  parameters.obstacles = {{{0.0, 0.0, 0.17}, 0.1}};
  return parameters;
}

ParticleFrame block_above_ball() {
  return block(Vec3d(-0.1, -0.06, 0.31), 10, 8, 8, Vec3f(0.0F, 0.0F, -2.0F));
}

TEST(FluidSimulator, CollidingBodiesKeepTheirMomentum) {
  SimulatorParameters parameters = test_parameters();
  parameters.gravity = 0.0;
  const ParticleFrame left = block(Vec3d(-0.3, 0.0, 1.0), 9, 9, 9, Vec3f(1.5F, 0.2F, 0.0F));
  const ParticleFrame right = block(Vec3d(0.0, 0.11, 1.06), 8, 8, 8, Vec3f(-1.0F, 0.0F, 0.3F));
  FluidSimulator simulator(parameters, both(left, right));
  const std::size_t count = simulator.frame().size();
  const Momentum start = momentum(simulator.frame(), 0, count);
  const double start_of_left = momentum(simulator.frame(), 0, left.size()).linear.x();
  for (int n = 0; n < 12; ++n) simulator.step();
  const Momentum end = momentum(simulator.frame(), 0, count);
  EXPECT_LT((end.linear - start.linear).norm(), 1e-5 * start.speeds);
  EXPECT_LT((end.angular - start.angular).norm(), 1e-5 * start.speeds);
  EXPECT_LT(momentum(simulator.frame(), 0, left.size()).linear.x(), 0.7 * start_of_left) << "they must collide";
}

TEST(FluidSimulator, FallsFreely) {
  SimulatorParameters parameters = test_parameters();
  const Vec3f velocity(0.3F, -0.2F, 0.5F);
  FluidSimulator simulator(parameters, block(Vec3d(0.0, 0.0, 1.0), 6, 6, 6, velocity));
  const ParticleFrame start = simulator.frame();
  int substeps = 0;
  for (int n = 1; n <= 24; ++n) {
    simulator.step();
    substeps += simulator.report().substeps;
    const double t = n * parameters.frame_interval;
    const Vec3d fallen = t * velocity.cast<double>() - Vec3d(0.0, 0.0, 0.5 * parameters.gravity * t * t);
    for (std::size_t i = 0; i < start.size(); ++i) {
      const Vec3d moved = (simulator.frame().positions[i] - start.positions[i]).cast<double>();
      ASSERT_LT((moved - fallen).norm(), 1e-5) << n;
    }
    EXPECT_EQ(simulator.frame().stamp_ns, std::llround(t * 1e9));
  }
  EXPECT_GT(substeps, 40) << "the substeps must differ, or this test is too easy";
}

TEST(FluidSimulator, NothingEntersWallsOrObstacles) {
  const SimulatorParameters parameters = ball_in_tank();
  FluidSimulator simulator(parameters, block_above_ball());
  const Boundary boundary(parameters);
  double nearest = std::numeric_limits<double>::infinity();
  bool on_ball = false;
  bool on_floor = false;
  for (int n = 0; n < 45; ++n) {
    for (const Vec3f& position : simulator.step().positions) {
      const Vec3d center = position.cast<double>();
      nearest = std::min(nearest, boundary.clearance(center));
      on_floor = on_floor || center.z() < 0.6 * test_spacing;
      on_ball = on_ball || (center - parameters.obstacles[0].center).norm() < 0.1 + 0.6 * test_spacing;
    }
  }
  EXPECT_GT(nearest, 0.5 * test_spacing - 1e-7);
  EXPECT_TRUE(on_ball);
  EXPECT_TRUE(on_floor);
}

// Half of a tank, 16 r wide, is filled 12 r high; at rest the liquid is 6 r deep.
TEST(FluidSimulator, APoolSettlesAtTheRestDensity) {
  SimulatorParameters parameters = test_parameters();
  parameters.frame_interval = 1.0 / 30.0;
  parameters.tank_half_width = 8.0 * test_spacing;
  const double first = -7.5 * test_spacing;
  FluidSimulator simulator(parameters, block(Vec3d(first, first, 0.5 * test_spacing), 8, 16, 12));
  double densest = 0.0;
  const Kernel kernel(2.0 * test_spacing);
  for (int n = 0; n < 90; ++n) simulator.step();

  const std::vector<Vec3f>& positions = simulator.frame().positions;
  double height = 0.0;
  double top = 0.0;
  for (const Vec3f& position : positions) {
    height += position.z() / static_cast<double>(positions.size());
    top = std::max(top, double{position.z()});
    // Far from walls, whose share of the density this sum leaves out.
    if (position.head<2>().cwiseAbs().maxCoeff() > 6.0 * test_spacing || position.z() < 2.0 * test_spacing) continue;
    double density = 0.0;
    for (const Vec3f& other : positions) density += std::pow(test_spacing, 3) * kernel.value((other - position).norm());
    densest = std::max(densest, density);
  }
  EXPECT_NEAR(height, 3.0 * test_spacing, 0.01 * 3.0 * test_spacing) << "half of the depth";
  EXPECT_LT(top, 6.5 * test_spacing);
  EXPECT_GT(densest, 0.995);
  EXPECT_LT(densest, 1.005);
  EXPECT_LT(simulator.report().fastest, 0.05) << "it is at rest";
}

// A grid that fills the tank from wall to wall is in balance but for the edges, where two walls count twice: particles
// give way there a little, and then everything stands still.
TEST(FluidSimulator, WhatIsAtRestStaysAtRest) {
  SimulatorParameters parameters = test_parameters();
  parameters.tank_half_width = 5.0 * test_spacing;
  const double first = -4.5 * test_spacing;
  FluidSimulator simulator(parameters, block(Vec3d(first, first, 0.5 * test_spacing), 10, 10, 6));
  const ParticleFrame start = simulator.frame();
  for (int n = 0; n < 60; ++n) simulator.step();
  double farthest = 0.0;
  double mean = 0.0;
  for (std::size_t i = 0; i < start.size(); ++i) {
    const double moved = (simulator.frame().positions[i] - start.positions[i]).norm();
    farthest = std::max(farthest, moved);
    mean += moved / static_cast<double>(start.size());
  }
  EXPECT_LT(mean, 0.05 * test_spacing);
  EXPECT_LT(farthest, 0.25 * test_spacing);
  EXPECT_LT(simulator.report().fastest, 0.01);
}

TEST(FluidSimulator, ThreadsDoNotChangeTheBytes) {
  std::vector<ParticleFrame> frames;
  for (const int threads : {1, 2, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    FluidSimulator simulator(ball_in_tank(), block_above_ball());
    for (int n = 0; n < 12; ++n) simulator.step();
    frames.push_back(simulator.frame());
  }
  for (const int other : {1, 2}) {
    EXPECT_TRUE(same_bytes(frames[0].positions, frames[other].positions));
    EXPECT_TRUE(same_bytes(frames[0].velocities, frames[other].velocities));
  }
}

TEST(FluidSimulator, KeepsIdsAndTheirOrder) {
  ParticleFrame start = block_above_ball();
  std::shuffle(start.ids.begin(), start.ids.end(), std::mt19937(1));
  for (std::uint32_t& id : start.ids) id = 1000000U + 3U * id;
  start.stamp_ns = 5000000000;
  const ParticleFrame sorted = make_particle_frame(0, start.positions, start.ids, start.velocities);
  FluidSimulator simulator(ball_in_tank(), start);
  EXPECT_EQ(simulator.frame().ids, sorted.ids);
  EXPECT_TRUE(same_bytes(simulator.frame().positions, sorted.positions));
  simulator.step();
  EXPECT_EQ(simulator.frame().ids, sorted.ids);
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    EXPECT_LT((simulator.frame().positions[i] - sorted.positions[i]).norm(), 4.0F / 30.0F);
  }
  EXPECT_EQ(simulator.frame().stamp_ns, 5033333333);
}

}  // namespace
}  // namespace particle_surface_tracker::simulator
