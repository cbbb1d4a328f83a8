#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker::test {

/// A mesh and a lattice that meet in some unpleasant way.
struct LatticeCase {
  std::string name;
  double h;
  TriangleMesh mesh;
};

/// How coordinates are drawn.
enum class Coordinates {
  kRandom,       ///< Anywhere.
  kOnLattice,    ///< Multiples of h, h/2 and h/4: on nodes, lattice edges and planes, parallel to each other.
  kNearLattice,  ///< fl32(fl(k·h)) for an h that is no float: next to planes, at the distance of rounding.
  kNudged,       ///< As kOnLattice, but some by 2⁻²⁴ m off.
  kFarAway,      ///< As kOnLattice, but 2²⁰ cells from the origin.
};

/// Random triangles that share vertices; not a closed mesh. Some are degenerate.
LatticeCase random_triangles(std::uint32_t seed, Coordinates coordinates);

/// A closed mesh with random places for its vertices, overlapping itself. Some of its triangles are degenerate.
LatticeCase random_closed_mesh(std::uint32_t seed, Coordinates coordinates);

/// Bodies made to touch the lattice and each other: boxes on planes, nested, overlapping, coincident, inside out,
/// flat, huge.
std::vector<LatticeCase> aligned_bodies();

}  // namespace particle_surface_tracker::test
