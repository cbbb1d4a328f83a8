#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "half_edges.h"
#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// Positions and connectivity of a closed mesh.
struct ConnectedTriangles {
  const std::vector<Vec3f>& positions;
  const std::vector<Triangle>& triangles;
  const std::vector<std::uint32_t>& twins;

  /// Calls visit(half_edge) for every half-edge that starts where this one does.
  template <typename Visit>
  void for_each_around(std::uint32_t half_edge, Visit&& visit) const {
    std::uint32_t h = half_edge;
    do {
      visit(h);
      h = twins[previous_half_edge(h)];
    } while (h != half_edge);
  }
};

/// Two triangles that have more in common than the vertices that they share.
using CrossingPair = std::pair<std::uint32_t, std::uint32_t>;

/// Finds the triangles within two rings of some others that cross them. Triangles that share an edge do not count: that
/// is a matter of folds.
/// \param around increasing indices of triangles.
/// \return pairs (one of `around`, another one), by the first; the same for any number of threads.
std::vector<CrossingPair> find_crossings(const ConnectedTriangles& mesh, const std::vector<std::uint32_t>& around);

/// As find_crossings(), but ends with the first that is found.
/// \param pair tried first; receives what was found.
/// \return whether there is one.
bool find_crossing(const ConnectedTriangles& mesh, const std::vector<std::uint32_t>& around, CrossingPair& pair);

}  // namespace particle_surface_tracker
