#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace particle_surface_tracker {

/// ∇²ψ = 0 on a sparse set of nodes with fixed values around it (Eq. 4 and Sec. 6.2).
///
/// ψ_i is the mean of those of its six neighbours that are there: they are the diagonal α_ii = N_i. The unknowns are in
/// the order of their coordinates, so that no more than three neighbours come before any of them.
struct PoissonProblem {
  /// Index of each unknown's neighbours at −x, +x, −y, +y, −z, +z in `values`; a missing one is the last value.
  std::vector<std::array<std::uint32_t, 6>> neighbors;

  std::vector<std::uint8_t> diagonal;  ///< N_i, at least 1.
  std::vector<std::uint8_t> is_red;    ///< The coordinates' sum is even: neighbours differ in colour.
  std::vector<double> values;          ///< ψ of the unknowns, then of the fixed nodes [m], then one 0.

  /// N of ω_opt(N): most nodes along one axis of a connected set of unknowns.
  int width = 1;

  std::size_t size() const { return neighbors.size(); }

  double sum_of_neighbors(std::size_t i) const {
    const std::array<std::uint32_t, 6>& at = neighbors[i];
    return ((values[at[0]] + values[at[1]]) + (values[at[2]] + values[at[3]])) + (values[at[4]] + values[at[5]]);
  }
};

/// How a solver ended.
struct SolverResult {
  int iterations = 0;
  bool converged = false;
};

/// Successive over-relaxation (Eq. 5), first the red nodes and then the black ones, with ω_opt(N), from the values that
/// are there until no step is longer than β. The same for any number of threads.
/// \param beta [m].
SolverResult solve_sor(PoissonProblem& problem, double beta, int max_iterations);

/// Conjugate gradients with an incomplete Cholesky factorisation (OpenVDB's), from the values that are there until the
/// largest residual is below `tolerance` times the largest right-hand side. The same for any number of threads.
SolverResult solve_pcg(PoissonProblem& problem, double tolerance, int max_iterations);

/// A first guess: every unknown gets the mean of those neighbours that are closer to the fixed nodes, layer by layer.
void guess_from_fixed_values(PoissonProblem& problem);

/// Largest |ψ_i − mean of its neighbours| [m].
double largest_residual(const PoissonProblem& problem);

}  // namespace particle_surface_tracker
