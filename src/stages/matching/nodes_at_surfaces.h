#pragma once

#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/stages/mesh_lattice.h"
#include "stages/nodes/node_masks.h"

namespace particle_surface_tracker {

/// Nodes of Γ in the cells of φ that the isosurface passes through, by their side.
struct NodesAtIsosurface {
  NodeMasks inside;
  NodeMasks outside;
};

/// \param h Δx_Γ [m].
NodesAtIsosurface nodes_at_isosurface(const ImplicitSurface& surface, double h);

/// Nodes of Γ at both ends of the lattice edges that the mesh crosses.
NodeMasks nodes_at_mesh(const MeshLattice& lattice);

/// Both.
NodeMasks nodes_at_surfaces(const MeshLattice& lattice, const ImplicitSurface& surface);

}  // namespace particle_surface_tracker
