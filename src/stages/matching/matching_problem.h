#pragma once

#include <cstdint>
#include <vector>

#include "matching_region.h"
#include "node_numbers.h"
#include "poisson_problem.h"

namespace particle_surface_tracker {

/// The Poisson problem of the unknowns of a region; ψ is still 0 everywhere.
struct MatchingProblem {
  NodeNumbers unknowns;
  std::vector<openvdb::Coord> fixed;  ///< Those next to an unknown, in the order of their values in the problem.
  PoissonProblem poisson;
  std::size_t free_unknowns = 0;  ///< In sets that touch no fixed node: ψ stays 0 there.

  explicit MatchingProblem(const MatchingNodes& nodes);
};

}  // namespace particle_surface_tracker
