#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "liquid_bodies.h"
#include "pressure_solver.h"
#include "viscosity_solver.h"

namespace particle_surface_tracker::simulator {
namespace {

SimulatorParameters wide_tank() {
  SimulatorParameters parameters = test_parameters();
  parameters.tank_half_width = 100.0;
  return parameters;
}

// A block of liquid far from all walls, sorted as the solvers want it.
struct Body {
  explicit Body(int width, double squeeze = 1.0) : surroundings(test_spacing), boundary(wide_tank()) {
    const double corner = -0.5 * (width - 1) * test_spacing;
    ParticleFrame frame = block(Vec3d(corner, corner, corner), width, width, width);
    for (Vec3f& position : frame.positions) position.x() *= static_cast<float>(squeeze);
    for (Vec3f& position : frame.positions) position.z() += 10.0F;
    const double cell = 2.0 * test_spacing;
    const ParticleGrid order(frame.positions, cell);
    std::vector<Vec3f> sorted;
    for (const std::uint32_t index : order.index()) sorted.push_back(frame.positions[index]);
    for (const Vec3f& position : sorted) positions.push_back(position.cast<double>());
    surroundings.survey(ParticleGrid(sorted, cell), positions, boundary);
  }

  // True for particles whose neighbours, and theirs, are all there.
  bool is_inner(std::size_t i, int width) const {
    const double half = (0.5 * (width - 1) - 4.0) * test_spacing;
    return (positions[i] - Vec3d(0.0, 0.0, 10.0)).cwiseAbs().maxCoeff() <= half + 0.1 * test_spacing;
  }

  Surroundings surroundings;
  Boundary boundary;
  std::vector<Vec3d> positions;
};

TEST(Surroundings, AGridHasTheRestDensityInside) {
  const Body body(11);
  for (std::size_t i = 0; i < body.positions.size(); ++i) {
    if (body.is_inner(i, 11)) {
      EXPECT_NEAR(body.surroundings.density[i], 1.0, 1e-4);
    }
    EXPECT_LT(body.surroundings.density[i], 1.0001);
  }
}

TEST(Surroundings, WallsCompleteTheDensityOfAGridBesideThem) {
  const ParticleFrame frame = block(Vec3d(0.0, 0.0, 0.5 * test_spacing), 7, 7, 7);
  const ParticleGrid order(frame.positions, 2.0 * test_spacing);
  std::vector<Vec3f> sorted;
  for (const std::uint32_t index : order.index()) sorted.push_back(frame.positions[index]);
  std::vector<Vec3d> positions;
  for (const Vec3f& position : sorted) positions.push_back(position.cast<double>());
  Surroundings surroundings(test_spacing);
  surroundings.survey(ParticleGrid(sorted, 2.0 * test_spacing), positions, Boundary(wide_tank()));
  int beside = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3d from_middle = positions[i] - 3.0 * test_spacing * Vec3d(1.0, 1.0, 0.0);
    if (from_middle.head<2>().norm() > 1.1 * test_spacing || positions[i].z() > 1.6 * test_spacing) continue;
    EXPECT_NEAR(surroundings.density[i], 1.0, 0.01) << positions[i].z();
    ++beside;
  }
  EXPECT_EQ(beside, 10);
}

// The mean acceleration, over the viscosity and inside of the body, of the flow v = (e·x)² d. It has no divergence and
// the Laplacian 2 d if d and e are orthogonal and of length 1.
double acceleration_of_shear(const Vec3d& d, const Vec3d& e) {
  const int width = 13;
  const Body body(width);
  const double viscosity = 0.1;
  const double duration = 1e-5;
  std::vector<Vec3f> velocities;
  for (const Vec3d& position : body.positions) {
    velocities.push_back((std::pow(e.dot(position - Vec3d(0.0, 0.0, 10.0)), 2) * d).cast<float>());
  }
  const std::vector<Vec3f> before = velocities;
  EXPECT_GT(ViscositySolver(viscosity, 0.0).solve(body.surroundings, duration, velocities), 0);
  double sum = 0.0;
  int inner = 0;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    if (!body.is_inner(i, width)) continue;
    const Vec3d acceleration = (velocities[i] - before[i]).cast<double>() / duration / viscosity;
    EXPECT_LT((acceleration - acceleration.dot(d) * d).norm(), 0.01);
    sum += acceleration.dot(d);
    ++inner;
  }
  EXPECT_EQ(inner, 125);
  return sum / inner;
}

// A cubic grid resists shear along its diagonals more than along its axes; the mean over all directions is Voigt's.
TEST(ViscositySolver, AcceleratesByTheLaplacian) {
  const double along_axes = acceleration_of_shear({1.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  const double along_diagonals =
      acceleration_of_shear({std::sqrt(0.5), std::sqrt(0.5), 0.0}, {std::sqrt(0.5), -std::sqrt(0.5), 0.0});
  EXPECT_NEAR((3.0 * along_axes + 2.0 * along_diagonals) / 5.0, 2.0, 0.04) << along_axes << ' ' << along_diagonals;
}

TEST(ViscositySolver, LeavesRigidMotionAlone) {
  const Body body(8);
  std::vector<Vec3f> velocities;
  for (const Vec3d& position : body.positions) {
    velocities.push_back((Vec3d(1.0, 2.0, 3.0) + Vec3d(0.5, -1.0, 2.0).cross(position)).cast<float>());
  }
  const std::vector<Vec3f> before = velocities;
  ViscositySolver(10.0, 1.0).solve(body.surroundings, 0.01, velocities);
  for (std::size_t i = 0; i < velocities.size(); ++i) EXPECT_LT((velocities[i] - before[i]).norm(), 1e-3);
}

TEST(ViscositySolver, WithoutViscosityDoesNothing) {
  const Body body(4);
  std::vector<Vec3f> velocities(body.positions.size(), Vec3f(1.0F, 0.0F, 0.0F));
  velocities.front() = Vec3f(-5.0F, 3.0F, 0.0F);
  EXPECT_EQ(ViscositySolver(0.0, 1.0).solve(body.surroundings, 0.01, velocities), 0);
  EXPECT_EQ(velocities.front(), Vec3f(-5.0F, 3.0F, 0.0F));
}

TEST(PressureSolver, LeavesLiquidThatIsNotTooDenseAlone) {
  const Body body(6, 1.1);
  std::vector<float> multipliers(body.positions.size(), 0.0F);
  std::vector<Vec3f> displacements(body.positions.size(), Vec3f(1e-3F, 0.0F, -1e-3F));
  const PressureReport report =
      PressureSolver(1e-3).solve(body.surroundings, body.boundary, body.positions, multipliers, displacements);
  EXPECT_EQ(report.iterations, 0);
  for (const Vec3f& displacement : displacements) EXPECT_EQ(displacement, Vec3f(1e-3F, 0.0F, -1e-3F));
}

// How much denser displacements make the inside of a body, at its densest place.
double compression_inside(const Body& body, int width, const std::vector<Vec3f>& displacements) {
  double highest = -1.0;
  for (std::size_t i = 0; i < displacements.size(); ++i) {
    if (!body.is_inner(i, width)) continue;
    double compression = 0.0;
    for (const Neighbor& neighbor : body.surroundings.neighborhoods.of(i)) {
      compression += neighbor.slope * neighbor.offset.dot(displacements[i] - displacements[neighbor.index]);
    }
    highest = std::max(highest, compression);
  }
  return highest;
}

TEST(PressureSolver, StopsCompression) {
  const int width = 13;
  const Body body(width);
  const std::size_t count = body.positions.size();
  std::vector<float> multipliers(count, 0.0F);
  std::vector<Vec3f> displacements;
  for (const Vec3d& position : body.positions) {
    displacements.push_back((-0.02 * (position - Vec3d(0.0, 0.0, 10.0))).cast<float>());
  }
  ASSERT_NEAR(compression_inside(body, width, displacements), 0.06, 0.03 * 0.06)
      << "a grid samples the kernel coarsely";
  const PressureReport report =
      PressureSolver(1e-4).solve(body.surroundings, body.boundary, body.positions, multipliers, displacements);
  EXPECT_GT(report.iterations, 5);
  EXPECT_LE(report.error, 1e-4);
  EXPECT_LT(compression_inside(body, width, displacements), 1e-3);
  Vec3d sum = Vec3d::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_GE(multipliers[i], 0.0F);
    sum += displacements[i].cast<double>();
  }
  EXPECT_LT(sum.norm(), 1e-6 * test_spacing * static_cast<double>(count));
}

TEST(PressureSolver, UndoesATenthOfAnExcess) {
  const int width = 13;
  const Body body(width, 0.97);
  std::vector<float> multipliers(body.positions.size(), 0.0F);
  std::vector<Vec3f> displacements(body.positions.size(), Vec3f::Zero());
  PressureSolver(1e-5).solve(body.surroundings, body.boundary, body.positions, multipliers, displacements);
  const double excess = 1.0 / 0.97 - 1.0;
  EXPECT_NEAR(compression_inside(body, width, displacements), -0.1 * excess, 0.01 * excess);
}

TEST(PressureSolver, StopsParticlesAtObstacles) {
  const double start = 10.0 - 1.5 * test_spacing;
  const Body body(4);
  SimulatorParameters parameters = wide_tank();
  parameters.obstacles = {{{0.0, 0.0, start - 0.5 * test_spacing - 5.0}, 5.0}};
  std::vector<float> multipliers(body.positions.size(), 0.0F);
  std::vector<Vec3f> displacements(body.positions.size(), Vec3f(0.0F, 0.0F, -0.4F * test_spacing));
  Surroundings surroundings = body.surroundings;
  std::vector<Vec3f> positions;
  for (const Vec3d& position : body.positions) positions.push_back(position.cast<float>());
  const Boundary boundary(parameters);
  surroundings.survey(ParticleGrid(positions, 2.0 * test_spacing), body.positions, boundary);
  PressureSolver(1e-3).solve(surroundings, boundary, body.positions, multipliers, displacements);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vec3d moved = body.positions[i] + displacements[i].cast<double>();
    EXPECT_GT(boundary.clearance(moved), (0.5 - 1e-5) * test_spacing);
  }
}

}  // namespace
}  // namespace particle_surface_tracker::simulator
