#include "falling_ring.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "fluid_simulator.h"
#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/mesh_measures.h"

namespace particle_surface_tracker::simulator {
namespace {

SimulatorParameters with_spacing(double spacing) {
  SimulatorParameters parameters = falling_ring_parameters();
  parameters.spacing = spacing;
  return parameters;
}

TEST(FallingRing, BeginsAboveItsBall) {
  const Scene scene = falling_ring(with_spacing(0.05));
  ASSERT_EQ(scene.parameters.obstacles.size(), 1U);
  const Sphere& ball = scene.parameters.obstacles[0];
  for (const Vec3f& position : scene.mesh.positions()) {
    ASSERT_GT((position.cast<double>() - ball.center).norm(), ball.radius + 0.05);
    ASSERT_GT(position.z(), 0.05);
  }
}

TEST(FallingRing, ParticlesFillTheMesh) {
  const Scene scene = falling_ring(with_spacing(0.05));
  const MeshMeasures measures = measure_mesh(scene.mesh.positions(), scene.mesh.triangles());
  Vec3d middle = Vec3d::Zero();
  for (const Vec3f& position : scene.particles.positions) middle += position.cast<double>();
  middle /= static_cast<double>(scene.particles.size());
  Vec3d middle_of_mesh = Vec3d::Zero();
  for (const Vec3f& position : scene.mesh.positions()) middle_of_mesh += position.cast<double>();
  middle_of_mesh /= static_cast<double>(scene.mesh.vertex_count());
  EXPECT_LT((middle - middle_of_mesh).norm(), 0.01) << "the mesh is moved as the particles are";
  EXPECT_NEAR(static_cast<double>(scene.particles.size()) * std::pow(0.05, 3), measures.volume, 0.15 * measures.volume);
}

// Half a second after the start the ring lies on its ball, at both sides of it.
TEST(FallingRing, DrapesOverItsBall) {
  const Scene scene = falling_ring(with_spacing(0.06));
  const Sphere& ball = scene.parameters.obstacles[0];
  FluidSimulator simulator(scene.parameters, scene.particles);
  for (int n = 0; n < 30; ++n) simulator.step();
  int touching = 0;
  int beyond = 0;
  for (const Vec3f& position : simulator.frame().positions) {
    const Vec3d offset = position.cast<double>() - ball.center;
    touching += offset.norm() < ball.radius + 0.06 ? 1 : 0;
    beyond += offset.z() < 0.0 ? 1 : 0;
  }
  EXPECT_GT(touching, 30);
  EXPECT_GT(beyond, 100);
}

TEST(FallingRing, TheLargestSpacingCanBeSimulated) {
  EXPECT_NO_THROW(check_simulator_parameters(falling_ring(with_spacing(0.075)).parameters));
}

TEST(FallingRing, OtherSpacingsAreErrors) {
  for (const double spacing : {0.0099, 0.076, 0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(falling_ring(with_spacing(spacing)), ParameterError) << spacing;
  }
}

}  // namespace
}  // namespace particle_surface_tracker::simulator
