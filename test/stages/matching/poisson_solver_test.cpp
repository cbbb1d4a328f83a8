#include "stages/matching/poisson_problem.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <Eigen/Dense>

#include "stages/matching/matching_problem.h"

namespace particle_surface_tracker {
namespace {

constexpr double kH = 0.05;          // [m]
constexpr double kBeta = 0.01 * kH;  // [m]
constexpr int kManyIterations = 100000;

/// A box of nodes of which some are fixed, some are missing and the others unknown.
MatchingNodes random_nodes(int width, double fixed_share, double missing_share, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform;
  MatchingNodes nodes;
  const openvdb::CoordBBox box(openvdb::Coord(-3), openvdb::Coord(width - 4));
  for (auto node = box.begin(); node; ++node) {
    const double draw = uniform(random);
    if (draw < missing_share) continue;
    (draw < missing_share + fixed_share ? nodes.fixed : nodes.unknown).insert(*node);
  }
  return nodes;
}

void fill_fixed_values(MatchingProblem& problem, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-2.0 * kH, 2.0 * kH);
  for (std::size_t n = 0; n < problem.fixed.size(); ++n) {
    problem.poisson.values[problem.poisson.size() + n] = uniform(random);
  }
}

/// Eq. 4 with the boundary conditions of Sec. 6.2, from the sets of nodes alone, solved directly. Sets of unknowns that
/// touch no fixed node make the matrix singular; the solution of least length is 0 there.
Eigen::VectorXd solve_directly(const MatchingProblem& problem) {
  const std::vector<openvdb::Coord>& nodes = problem.unknowns.nodes();
  const auto size = static_cast<Eigen::Index>(nodes.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right_side = Eigen::VectorXd::Zero(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j < size; ++j) {
      const openvdb::Coord d = nodes[i] - nodes[j];
      if (std::abs(d.x()) + std::abs(d.y()) + std::abs(d.z()) != 1) continue;
      matrix(i, j) = -1.0;
      matrix(i, i) += 1.0;
    }
    for (std::size_t f = 0; f < problem.fixed.size(); ++f) {
      const openvdb::Coord d = nodes[i] - problem.fixed[f];
      if (std::abs(d.x()) + std::abs(d.y()) + std::abs(d.z()) != 1) continue;
      matrix(i, i) += 1.0;
      right_side[i] += problem.poisson.values[nodes.size() + f];
    }
  }
  return matrix.completeOrthogonalDecomposition().solve(right_side);
}

double largest_difference(const PoissonProblem& problem, const Eigen::VectorXd& solution) {
  double largest = 0.0;
  for (std::size_t i = 0; i < problem.size(); ++i) {
    largest = std::max(largest, std::abs(problem.values[i] - solution[static_cast<Eigen::Index>(i)]));
  }
  return largest;
}

TEST(PoissonSolver, BothSolversAgreeWithADirectSolution) {
  for (std::uint32_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const double missing_share = seed % 2 == 0 ? 0.45 : 0.1;
    MatchingProblem problem(random_nodes(10, 0.03, missing_share, seed));
    fill_fixed_values(problem, seed);
    const Eigen::VectorXd solution = solve_directly(problem);

    PoissonProblem pcg = problem.poisson;
    EXPECT_TRUE(solve_pcg(pcg, 1e-10, kManyIterations).converged);
    EXPECT_LT(largest_difference(pcg, solution), 1e-7 * kH);

    PoissonProblem sor = problem.poisson;
    EXPECT_TRUE(solve_sor(sor, 1e-6 * kBeta, kManyIterations).converged);
    EXPECT_LT(largest_difference(sor, solution), 1e-4 * kBeta);
  }
}

TEST(PoissonSolver, ALinearFunctionBetweenTwoWallsIsExact) {
  MatchingNodes nodes;
  const openvdb::CoordBBox box(openvdb::Coord(0), openvdb::Coord(20, 4, 4));
  for (auto node = box.begin(); node; ++node) {
    ((*node).x() == 0 || (*node).x() == 20 ? nodes.fixed : nodes.unknown).insert(*node);
  }
  MatchingProblem problem(nodes);
  for (std::size_t n = 0; n < problem.fixed.size(); ++n) {
    problem.poisson.values[problem.poisson.size() + n] = 0.1 * problem.fixed[n].x();
  }
  EXPECT_EQ(problem.poisson.width, 19);
  ASSERT_TRUE(solve_pcg(problem.poisson, 1e-12, kManyIterations).converged);
  for (std::size_t i = 0; i < problem.poisson.size(); ++i) {
    EXPECT_NEAR(problem.poisson.values[i], 0.1 * problem.unknowns.nodes()[i].x(), 1e-10);
  }
  EXPECT_LT(largest_residual(problem.poisson), 1e-10);
}

TEST(PoissonSolver, WhatTouchesNoFixedNodeStaysZero) {
  MatchingNodes nodes;
  const openvdb::CoordBBox alone(openvdb::Coord(100), openvdb::Coord(105));
  for (auto node = alone.begin(); node; ++node) nodes.unknown.insert(*node);
  nodes.unknown.insert({0, 0, 0});
  nodes.fixed.insert({1, 0, 0});
  for (const bool use_pcg : {false, true}) {
    MatchingProblem problem(nodes);
    EXPECT_EQ(problem.free_unknowns, 6u * 6u * 6u);
    EXPECT_EQ(problem.poisson.width, 1);
    problem.poisson.values[problem.poisson.size()] = 3.0;
    guess_from_fixed_values(problem.poisson);
    const SolverResult result = use_pcg ? solve_pcg(problem.poisson, 1e-8, kManyIterations)
                                        : solve_sor(problem.poisson, kBeta, kManyIterations);
    EXPECT_TRUE(result.converged);
    EXPECT_EQ(problem.poisson.values[0], 3.0);
    for (std::size_t i = 1; i < problem.poisson.size(); ++i) EXPECT_EQ(problem.poisson.values[i], 0.0);
  }
}

TEST(PoissonSolver, NothingToSolveIsSolved) {
  MatchingNodes nodes;
  nodes.fixed.insert({0, 0, 0});
  MatchingProblem problem(nodes);
  EXPECT_TRUE(solve_pcg(problem.poisson, 1e-8, 10).converged);
  EXPECT_TRUE(solve_sor(problem.poisson, kBeta, 10).converged);
}

TEST(PoissonSolver, SolversAgreeWithinBetaWhereSorIsRunToAThousandthOfIt) {
  MatchingProblem problem(random_nodes(40, 0.001, 0.05, 11));
  fill_fixed_values(problem, 11);
  PoissonProblem pcg = problem.poisson;
  PoissonProblem sor = problem.poisson;
  EXPECT_TRUE(solve_pcg(pcg, 1e-8, kManyIterations).converged);
  EXPECT_TRUE(solve_sor(sor, 1e-3 * kBeta, kManyIterations).converged);
  for (std::size_t i = 0; i < pcg.size(); ++i) EXPECT_NEAR(pcg.values[i], sor.values[i], kBeta);
}

TEST(PoissonSolver, TheGuessLiesBetweenTheFixedValues) {
  MatchingProblem problem(random_nodes(20, 0.01, 0.1, 5));
  for (std::size_t n = 0; n < problem.fixed.size(); ++n) {
    problem.poisson.values[problem.poisson.size() + n] = n % 2 == 0 ? 1.0 : 2.0;
  }
  guess_from_fixed_values(problem.poisson);
  std::size_t zeros = 0;
  for (std::size_t i = 0; i < problem.poisson.size(); ++i) {
    const double guess = problem.poisson.values[i];
    zeros += guess == 0.0;
    EXPECT_TRUE(guess == 0.0 || (guess >= 1.0 && guess <= 2.0)) << guess;
  }
  EXPECT_EQ(zeros, problem.free_unknowns);
}

TEST(PoissonSolver, IsTheSameForAnyNumberOfThreads) {
  MatchingProblem problem(random_nodes(40, 0.002, 0.05, 7));
  fill_fixed_values(problem, 7);
  std::vector<std::vector<double>> sor_values;
  std::vector<std::vector<double>> pcg_values;
  for (const std::size_t threads : {1u, 2u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    PoissonProblem sor = problem.poisson;
    PoissonProblem pcg = problem.poisson;
    EXPECT_TRUE(solve_sor(sor, kBeta, kManyIterations).converged);
    EXPECT_TRUE(solve_pcg(pcg, 1e-8, kManyIterations).converged);
    sor_values.push_back(sor.values);
    pcg_values.push_back(pcg.values);
  }
  EXPECT_EQ(sor_values[0], sor_values[1]);
  EXPECT_EQ(pcg_values[0], pcg_values[1]);
}

}  // namespace
}  // namespace particle_surface_tracker
