#include "particle_surface_tracker/stages/implicit_function.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <tbb/global_control.h>
#include <Eigen/Eigenvalues>

#include "core/instruction_set.h"
#include "particle_surface_tracker/core/particle_grid.h"
#include "support/implicit_bodies.h"

namespace particle_surface_tracker::test::implicit {
namespace {

/// φ̃ as the documentation defines it, from all particles.
double field_by_definition(const Positions& positions, const Vec3d& x, const Parameters& parameters) {
  const double r = parameters.particle_spacing;
  const double radius = parameters.influence_radius * r;
  double sum_k = 0.0;
  Vec3d sum_kp = Vec3d::Zero();
  Vec3d sum_dk = Vec3d::Zero();
  Eigen::Matrix3d sum_p_dk = Eigen::Matrix3d::Zero();
  for (const Vec3f& position : positions) {
    const Vec3d p = position.cast<double>() - x;  // Around x, which changes no derivative and keeps the digits.
    const double s2 = p.squaredNorm() / (radius * radius);
    if (s2 >= 1.0) continue;
    const double k = std::pow(1.0 - s2, 3);
    const Vec3d dk = 6.0 * std::pow(1.0 - s2, 2) * p / (radius * radius);
    sum_k += k;
    sum_kp += k * p;
    sum_dk += dk;
    sum_p_dk += p * dk.transpose();
  }
  if (sum_k == 0.0) return radius;
  const Vec3d mean = sum_kp / sum_k;
  const Eigen::Matrix3d gradient = sum_p_dk / sum_k - mean * sum_dk.transpose() / sum_k;
  const Eigen::Matrix3d symmetric = 0.5 * (gradient + gradient.transpose());
  const double ev = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(symmetric).eigenvalues().maxCoeff();
  double f = 1.0;
  if (ev >= parameters.eigenvalue_low) {
    const double gamma =
        std::max(0.0, (parameters.eigenvalue_high - ev) / (parameters.eigenvalue_high - parameters.eigenvalue_low));
    f = std::pow(gamma, 3) - 3.0 * std::pow(gamma, 2) + 3.0 * gamma;
  }
  return mean.norm() - parameters.surface_radius * r * f;
}

void expect_values_by_definition(const Positions& positions, const Parameters& parameters) {
  const ImplicitSurface surface = evaluate(positions, parameters);
  ASSERT_GT(surface.field->activeVoxelCount(), 0u);
  double largest = 0.0;
  for (auto node = surface.field->cbeginValueOn(); node; ++node) {
    const Vec3d x = surface.dx * Vec3d(node.getCoord().x(), node.getCoord().y(), node.getCoord().z());
    largest = std::max(largest, std::abs(*node - field_by_definition(positions, x, parameters)));
  }
  EXPECT_LT(largest, 5e-6 * kR);
}

std::string bytes_of(const ImplicitSurface& surface) {
  std::string bytes;
  const auto append = [&bytes](const void* from, std::size_t size) {
    bytes.append(static_cast<const char*>(from), size);
  };
  for (auto leaf = surface.field->tree().cbeginLeaf(); leaf; ++leaf) {
    append(leaf->origin().data(), 3 * sizeof(openvdb::Int32));
    append(leaf->buffer().data(), 512 * sizeof(float));
    for (int n = 0; n < 8; ++n) {
      const auto word = leaf->valueMask().getWord<openvdb::Index64>(n);
      append(&word, sizeof(word));
    }
  }
  return bytes;
}

Positions two_slabs(double distance_of_layers) {
  Positions positions;
  for (int side = 0; side < 2; ++side) {
    for (int layer = 0; layer < 5; ++layer) {
      const double z = (side == 0 ? -1.0 : 1.0) * (0.5 * distance_of_layers + layer) * kR;
      for (int i = -9; i <= 9; ++i) {
        for (int j = -9; j <= 9; ++j) positions.push_back(Vec3d(i * kR, j * kR, z).cast<float>());
      }
    }
  }
  return positions;
}

/// Changes of sign of φ̃ along z at x = y = 0.
int surfaces_along_z(const Positions& positions, const Parameters& parameters) {
  const ParticleGrid grid(positions, implicit_function_cell_size(parameters));
  int changes = 0;
  bool was_inside = false;
  for (double z = -12.0 * kR; z <= 12.0 * kR; z += 0.01 * kR) {
    const bool is_inside = implicit_function_at(grid, {0.0, 0.0, z}, parameters) < 0.0;
    changes += is_inside != was_inside;
    was_inside = is_inside;
  }
  return changes;
}

TEST(ImplicitFunction, IsWhatTheDefinitionSays) {
  const Parameters parameters = make_parameters();
  expect_values_by_definition(random_cloud(600, 4.0 * kR, kSeed), parameters);
  expect_values_by_definition(fill(0.45, 0.0, [](const Vec3d&) { return true; }), parameters);
  expect_values_by_definition(fill(0.6, 0.0, [](const Vec3d& p) { return is_in_ball(p, 0.5); }), parameters);
  expect_values_by_definition(splash(), parameters);
}

TEST(ImplicitFunction, IsAsExactFarFromTheOrigin) {
  const Positions ball = fill(0.6, 0.2, [](const Vec3d& p) { return is_in_ball(p, 0.5); });
  expect_values_by_definition(moved(ball, {3000.0f, -2000.0f, 1000.0f}), make_parameters());
}

TEST(ImplicitFunction, AtAPositionIsWhatTheDefinitionSays) {
  const Parameters parameters = make_parameters();
  const Positions positions = splash();
  const ParticleGrid grid(positions, implicit_function_cell_size(parameters));
  for (const Vec3f& p : random_cloud(500, 2.0, kSeed + 40)) {
    const Vec3d x = p.cast<double>();
    EXPECT_NEAR(implicit_function_at(grid, x, parameters), field_by_definition(positions, x, parameters), 1e-9 * kR);
  }
  EXPECT_EQ(implicit_function_at(grid, {100.0, 0.0, 0.0}, parameters), parameters.influence_radius * kR);
}

TEST(ImplicitFunction, IsWhatTheDefinitionSaysForOtherCellSizes) {
  const Positions ball = fill(0.6, 0.2, [](const Vec3d& p) { return is_in_ball(p, 0.45); });
  for (const double dx_phi : {0.2, 0.25, 1.0 / 3.0, 0.4, 0.6, 1.0, 1.3}) {
    SCOPED_TRACE(dx_phi);
    expect_values_by_definition(ball, make_parameters(dx_phi));
  }
}

TEST(ImplicitFunction, OfASingleParticleIsABallOfTheSurfaceRadius) {
  const Parameters parameters = make_parameters();
  const ImplicitSurface surface = evaluate({{0.0f, 0.0f, 0.0f}}, parameters);
  for (auto node = surface.field->cbeginValueOn(); node; ++node) {
    const double distance = surface.dx * node.getCoord().asVec3d().length();
    EXPECT_NEAR(*node, distance - parameters.surface_radius * kR, 1e-6 * kR);
  }
}

TEST(ImplicitFunction, PutsTheSurfaceHalfASpacingOutsideAFlatBlock) {
  const Parameters parameters = make_parameters();
  const Positions positions = fill(0.8, 0.0, [](const Vec3d&) { return true; });
  const ParticleGrid grid(positions, implicit_function_cell_size(parameters));
  double outermost = -1.0;
  for (const Vec3f& p : positions) outermost = std::max(outermost, static_cast<double>(p.z()));
  for (const double x : {0.0, 0.02, 0.05}) {
    double inner = outermost - 0.5 * kR;
    double outer = outermost + 1.5 * kR;
    while (outer - inner > 1e-9) {
      const double middle = 0.5 * (inner + outer);
      (implicit_function_at(grid, {x, 0.5 * x, middle}, parameters) < 0.0 ? inner : outer) = middle;
    }
    EXPECT_NEAR((inner - outermost) / kR, 0.5, 0.06);
  }
}

TEST(ImplicitFunction, KeepsSlabsApartAndJoinsThem) {
  const Parameters parameters = make_parameters();
  for (const double gap : {2.25, 2.5, 3.0, 4.0})
    EXPECT_EQ(surfaces_along_z(two_slabs(gap + 1.0), parameters), 4) << gap;
  for (const double gap : {0.0, 0.5, 1.0, 1.25, 1.5}) {
    EXPECT_EQ(surfaces_along_z(two_slabs(gap + 1.0), parameters), 2) << gap;
  }
}

TEST(ImplicitFunction, HasTheSameBytesForAnyNumberOfThreads) {
  const Parameters parameters = make_parameters();
  const Positions positions = fill(1.2, 0.3, [](const Vec3d& p) { return is_in_ball(p, 1.1); });
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return bytes_of(evaluate(positions, parameters));
  };
  const std::string expected = with_threads(1);
  ASSERT_FALSE(expected.empty());
  for (int run = 0; run < 3; ++run) EXPECT_EQ(with_threads(2), expected);
  EXPECT_EQ(with_threads(5), expected);
}

TEST(ImplicitFunction, HasTheSameBytesForEveryInstructionSet) {
  const Parameters parameters = make_parameters();
  for (const Positions& positions : {splash(), fill(0.9, 0.3, [](const Vec3d& p) { return is_in_ball(p, 0.8); }),
                                     fill(0.5, 0.0, [](const Vec3d&) { return true; })}) {
    std::string expected;
    for (const InstructionSet set : {InstructionSet::kBaseline, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
      if (!is_supported(set)) continue;
      const ForcedInstructionSet forced(set);
      const std::string bytes = bytes_of(evaluate(positions, parameters));
      if (expected.empty()) expected = bytes;
      ASSERT_FALSE(bytes.empty());
      EXPECT_EQ(bytes, expected);
    }
  }
}

TEST(ImplicitFunction, IsEmptyWithoutParticles) {
  const ImplicitSurface surface = evaluate({}, make_parameters());
  ASSERT_NE(surface.field, nullptr);
  EXPECT_EQ(surface.field->activeVoxelCount(), 0u);
  EXPECT_DOUBLE_EQ(surface.dx, 0.5 * kR);
}

TEST(ImplicitFunction, IsLaidOutOnTheLatticeOfTheWorld) {
  const ImplicitSurface surface = evaluate({{0.3f, 0.1f, 0.2f}}, make_parameters());
  EXPECT_EQ(surface.field->getName(), "phi_tilde");
  EXPECT_TRUE(surface.field->indexToWorld(openvdb::Coord(2, -4, 6)).eq(openvdb::Vec3d(0.1, -0.2, 0.3)));
  EXPECT_FLOAT_EQ(surface.field->background(), 4.0f * static_cast<float>(kR));
}

}  // namespace
}  // namespace particle_surface_tracker::test::implicit
