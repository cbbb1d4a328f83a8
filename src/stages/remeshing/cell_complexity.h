#pragma once

#include <vector>

#include "cell_set.h"
#include "gamma_nodes.h"
#include "small_components.h"
#include "triangle_cuts.h"

namespace particle_surface_tracker::remeshing {

/// Cells in which mesh and Γ do not fit together, from the crossings alone: no face has to be looked at.
struct CellComplexity {
  CellSet complex;  ///< An edge is crossed twice or more, or the mesh winds around a corner neither 0 times nor once.
  CellSet tangled;  ///< Of these: between two crossings of an edge, or at a corner, sheets overlap or are inside out.
  NodeMasks near_sign_change;  ///< A corner, or a node within distance 1 of one, has another sign than the others.
};

/// One walk along all lattice lines that the mesh crosses.
CellComplexity classify_cells(const GammaNodes& gamma);

/// Cells that hold a piece of the mesh while all nodes up to distance 1 around them are on one side: the surface there
/// is thinner than Γ can see (deep cell test). Sorted.
std::vector<openvdb::Coord> find_deep_cells(TriangleCuts& cuts, const NodeMasks& near_sign_change,
                                            const SmallComponents& small);

}  // namespace particle_surface_tracker::remeshing
