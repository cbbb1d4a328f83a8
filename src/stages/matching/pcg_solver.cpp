#include <algorithm>

#include <openvdb/math/ConjGradient.h>

#include "poisson_problem.h"

namespace particle_surface_tracker {

namespace {

using Matrix = openvdb::math::pcg::SparseStencilMatrix<double, 7>;
using Vector = openvdb::math::pcg::VectorD;
using Preconditioner = openvdb::math::pcg::IncompleteCholeskyPreconditioner<Matrix>;

/// The matrix of the unknowns; what the fixed nodes contribute is the right-hand side.
void assemble(const PoissonProblem& problem, Matrix& matrix, Vector& right_side) {
  const auto size = static_cast<std::uint32_t>(problem.size());
  for (std::uint32_t i = 0; i < size; ++i) {
    double sum = 0.0;
    for (const std::uint32_t n : problem.neighbors[i]) {
      if (n < size) {
        matrix.setValue(i, n, -1.0);
      } else {
        sum += problem.values[n];
      }
    }
    matrix.setValue(i, i, problem.diagonal[i]);
    right_side[i] = sum;
  }
}

}  // namespace

SolverResult solve_pcg(PoissonProblem& problem, double tolerance, int max_iterations) {
  // The library gives up where the residual grows by a half, which it may do on the way; it goes on from there then.
  constexpr int kMostRestarts = 10;
  SolverResult result;
  const auto size = static_cast<openvdb::math::pcg::SizeType>(problem.size());
  if (size == 0) return {0, true};
  Matrix matrix(size);
  Vector right_side(size);
  Vector solution(size);
  assemble(problem, matrix, right_side);
  std::copy(problem.values.begin(), problem.values.begin() + size, solution.data());
  Preconditioner preconditioner(matrix);
  for (int start = 0; start <= kMostRestarts && !result.converged; ++start) {
    const openvdb::math::pcg::State limits = {false, max_iterations - result.iterations, tolerance, 0.0};
    const openvdb::math::pcg::State state =
        openvdb::math::pcg::solve(matrix, right_side, solution, preconditioner, limits);
    result.iterations += state.iterations;
    result.converged = state.success;
  }
  std::copy(solution.data(), solution.data() + size, problem.values.begin());
  return result;
}

}  // namespace particle_surface_tracker
