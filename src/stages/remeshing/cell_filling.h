#pragma once

#include "cell_set.h"
#include "face_paths.h"
#include "gamma_nodes.h"
#include "patch.h"

namespace particle_surface_tracker::remeshing {

/// Fills the marked cells by the surface Γ = 0, joined to the front vertices of the patch: adds vertices on inner edges
/// and in the middle of loops (without places), and triangles.
/// \return false if something on the front does not fit together; the patch is then to be thrown away.
bool fill_cells(const CellSet& marked, GammaNodes& gamma, FaceTracer& tracer, Patch& patch);

}  // namespace particle_surface_tracker::remeshing
