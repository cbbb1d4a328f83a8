#pragma once

#include "patch.h"

namespace particle_surface_tracker::remeshing {

/// Closest that two new vertices come to each other on their lattice edge or mesh edge [cells].
constexpr double kLeastGap = 0.02;

/// Gives the front vertices of a patch (all it has so far) their places on the mesh, and what their attributes are
/// blended from. So that none falls on another one or on a vertex of the mesh, they keep a small distance from the ends
/// of their edges; what they move by lies in the mesh.
void place_front_vertices(const MeshLattice& lattice, Patch& patch);

}  // namespace particle_surface_tracker::remeshing
