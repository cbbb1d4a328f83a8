#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "poisson_problem.h"

namespace particle_surface_tracker {

namespace {

constexpr double kPi = 3.14159265358979323846;

/// Yang and Gobbert's factor for a grid of N × N × N (Sec. 6.1).
double optimal_relaxation(int width) {
  return 2.0 / (1.0 + std::sin(kPi / (width + 1)));
}

/// Updates the nodes of one colour, which depend on the other colour only, and returns the longest step.
double relax(PoissonProblem& problem, const std::vector<std::uint32_t>& nodes, double omega) {
  constexpr std::size_t kGrain = 2048;
  const auto update = [&](const tbb::blocked_range<std::size_t>& range, double longest) {
    for (std::size_t n = range.begin(); n != range.end(); ++n) {
      const std::uint32_t i = nodes[n];
      const double step = omega * (problem.sum_of_neighbors(i) / problem.diagonal[i] - problem.values[i]);
      problem.values[i] += step;
      longest = std::max(longest, std::abs(step));
    }
    return longest;
  };
  return tbb::parallel_reduce(tbb::blocked_range<std::size_t>(0, nodes.size(), kGrain), 0.0, update,
                              [](double a, double b) { return std::max(a, b); });
}

}  // namespace

SolverResult solve_sor(PoissonProblem& problem, double beta, int max_iterations) {
  std::vector<std::uint32_t> red;
  std::vector<std::uint32_t> black;
  for (std::uint32_t i = 0; i < problem.size(); ++i) (problem.is_red[i] != 0 ? red : black).push_back(i);
  const double omega = optimal_relaxation(problem.width);
  SolverResult result;
  while (!result.converged && result.iterations < max_iterations) {
    const double red_step = relax(problem, red, omega);
    const double black_step = relax(problem, black, omega);
    result.converged = std::max(red_step, black_step) < beta;
    ++result.iterations;
  }
  return result;
}

}  // namespace particle_surface_tracker
