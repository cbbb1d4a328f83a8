#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace particle_surface_tracker::remeshing {

/// A flat piece of a triangle to be triangulated: loops with the piece on the left, the first one around it or, with
/// holes in it, in any order.
struct FlatPiece {
  std::vector<std::vector<std::uint32_t>> loops;  ///< Of indices into `places`; an index may occur more than once.
  const std::vector<Eigen::Vector2d>* places;     ///< In the plane of the triangle [any unit].
  const std::vector<std::uint8_t>* edges;         ///< Bit k: the vertex lies on edge k of the triangle.
  const std::vector<std::pair<std::uint32_t, std::uint32_t>>* apart;  ///< Pairs (lower, higher) that must not be
                                                                      ///< joined inside the piece; sorted.
};

/// Triangulates a piece. Vertices on the same edge of the triangle and those of `apart` are never joined, no two
/// vertices are joined twice, and every loop edge has one triangle: whatever rounding does to the places, the result is
/// a surface with the loops as its border. The places only decide which of these triangulations is the best.
/// \return false if none was found.
bool triangulate_piece(const FlatPiece& piece, std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace particle_surface_tracker::remeshing
