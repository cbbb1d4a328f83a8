#pragma once

#include "gamma_nodes.h"
#include "patch.h"

namespace particle_surface_tracker::remeshing {

/// Places the vertices of the filling on the surface Γ = 0: those on lattice edges where the mesh crosses the edge or,
/// where topology matching has changed Γ, at its linear zero; those in the middle of loops at a zero nearby.
void place_filling(GammaNodes& gamma, Patch& patch);

/// Evens out the vertices of the filling by moving them tangentially, so that the cells do not show. Front vertices
/// stay, and no triangle is turned over.
void smooth_filling(double h, Patch& patch);

/// Gives the vertices of the filling the weights by which they take over the attributes of the mesh: those of the
/// closest place on it, if one is near.
void blend_filling(const MeshLattice& lattice, Patch& patch);

/// Moves new vertices by as little as it takes for no two vertices of an edge, and no two new vertices, to be in the
/// same place once rounded.
void keep_places_apart(const std::vector<Vec3f>& positions, double h, Patch& patch);

}  // namespace particle_surface_tracker::remeshing
