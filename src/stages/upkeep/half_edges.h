#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

// Half-edge 3 t + k runs from corner k of triangle t to the next corner, counter-clockwise.

constexpr std::uint32_t kNoHalfEdge = 0xffffffffU;

inline std::uint32_t next_half_edge(std::uint32_t half_edge) {
  return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

inline std::uint32_t previous_half_edge(std::uint32_t half_edge) {
  return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1;
}

inline std::uint32_t start_of(const std::vector<Triangle>& triangles, std::uint32_t half_edge) {
  return triangles[half_edge / 3][half_edge % 3];
}

inline std::uint32_t end_of(const std::vector<Triangle>& triangles, std::uint32_t half_edge) {
  return start_of(triangles, next_half_edge(half_edge));
}

/// For every half-edge of a closed, oriented 2-manifold the one that runs the other way on the same edge.
/// \param twins receives them; its memory is used again.
/// \throw MeshError if an edge has not exactly one triangle on either side, or a vertex more than one umbrella.
void pair_half_edges(std::size_t vertex_count, const std::vector<Triangle>& triangles,
                     std::vector<std::uint32_t>& twins);

/// The same, without an exception.
/// \return what is wrong with the mesh, or nothing; `twins` are of no use if there is something.
std::string try_to_pair_half_edges(std::size_t vertex_count, const std::vector<Triangle>& triangles,
                                   std::vector<std::uint32_t>& twins);

/// Whether the three half-edges of a triangle and their twins run along the same edges in opposite directions: false
/// for pairs that belong to other triangles, or are none.
bool twins_fit(const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& twins, std::uint32_t triangle);

/// Whether `twins` are those of these triangles.
bool twins_fit(const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& twins);

/// As pair_half_edges(), unless `twins` are those of these triangles already.
void update_twins(std::size_t vertex_count, const std::vector<Triangle>& triangles, std::vector<std::uint32_t>& twins);

}  // namespace particle_surface_tracker
