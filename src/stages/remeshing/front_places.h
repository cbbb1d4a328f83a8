#pragma once

#include "patch.h"

namespace particle_surface_tracker::remeshing {

/// Distance that front vertices keep from each other and from the ends of their mesh edge, triangle or lattice edge
/// [cells]. Small: what a vertex moves by bends the line along which the mesh was cut.
constexpr double kFrontGap = 0.002;

/// Distance that vertices on inner lattice edges keep from the ends of the edge [cells].
constexpr double kInnerGap = 0.02;

/// Gives the front vertices of a patch (all it has so far) their places on the mesh, and what their attributes are
/// blended from. So that none falls on another one or on a vertex of the mesh, they keep a small distance from the ends
/// of their edges; what they move by lies in the mesh.
void place_front_vertices(const MeshLattice& lattice, Patch& patch);

}  // namespace particle_surface_tracker::remeshing
