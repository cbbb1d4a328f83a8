#include "poisson_problem.h"

#include <algorithm>
#include <cmath>

namespace particle_surface_tracker {

void guess_from_fixed_values(PoissonProblem& problem) {
  constexpr std::uint32_t kUnreached = 0xffffffff;
  const auto size = static_cast<std::uint32_t>(problem.size());
  const auto missing = static_cast<std::uint32_t>(problem.values.size() - 1);
  std::vector<std::uint32_t> layer(size, kUnreached);
  std::vector<std::uint32_t> reached;
  for (std::uint32_t i = 0; i < size; ++i) {
    const auto& at = problem.neighbors[i];
    if (std::none_of(at.begin(), at.end(), [&](std::uint32_t n) { return n >= size && n < missing; })) continue;
    layer[i] = 0;
    reached.push_back(i);
  }
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const std::uint32_t i = reached[next];
    double sum = 0.0;
    int count = 0;
    for (const std::uint32_t n : problem.neighbors[i]) {
      if (n == missing) continue;
      if (n >= size || layer[n] < layer[i]) {
        sum += problem.values[n];
        ++count;
      } else if (layer[n] == kUnreached) {
        layer[n] = layer[i] + 1;
        reached.push_back(n);
      }
    }
    problem.values[i] = sum / count;
  }
}

double largest_residual(const PoissonProblem& problem) {
  double largest = 0.0;
  for (std::size_t i = 0; i < problem.size(); ++i) {
    largest = std::max(largest, std::abs(problem.values[i] - problem.sum_of_neighbors(i) / problem.diagonal[i]));
  }
  return largest;
}

}  // namespace particle_surface_tracker
