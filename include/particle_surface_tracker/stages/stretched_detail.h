#pragma once

#include <vector>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// Thins detail out where the surface grows, so that the layer of liquid that δ stands for keeps its volume: δ shrinks
/// by the factor by which the triangles around a vertex have grown since its detail was born, and comes back as they
/// shrink again. With δ as it is in the paper, a splash of three times the area carries three times the liquid in its
/// detail, and the mesh swells against φ = 0 (docs/upkeep.md).
///
/// A growth by up to 2 leaves every bit of δ alone, so motion that is almost rigid does not touch it.
/// \param mesh has just been advected.
/// \param before the vertices' positions in the frame before [m]; the triangles are still the same.
void thin_stretched_detail(TriangleMesh& mesh, const std::vector<Vec3f>& before);

}  // namespace particle_surface_tracker
