#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "particle_surface_tracker/core/triangle_mesh.h"
#include "particle_surface_tracker/stages/remeshing.h"

namespace particle_surface_tracker::test {

/// A mesh and what is to be made anew in it, from a seed.
struct RemeshingCase {
  std::string description;  ///< What the mesh is made of.
  TriangleMesh mesh;
  double h = 0.1;  ///< Cell size of Γ [m].
  RemeshingRequest request;
};

/// One to four bodies that overlap, touch, coincide or lie in each other: spheres, tori and boxes of all sizes from a
/// hundredth of a cell to twenty cells, thin ones, some turned inside out, some with all coordinates on the lattice or
/// on simple fractions of it. Cells are flagged at random, and Γ has new values at some nodes.
RemeshingCase make_remeshing_case(std::uint32_t seed);

}  // namespace particle_surface_tracker::test
