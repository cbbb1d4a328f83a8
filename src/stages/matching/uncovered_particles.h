#pragma once

#include <cstdint>
#include <vector>

#include "line_signs.h"
#include "particle_surface_tracker/core/triangle_mesh.h"
#include "particle_surface_tracker/core/types.h"
#include "particle_surface_tracker/stages/topology_matching.h"
#include "stages/nodes/node_masks.h"

namespace particle_surface_tracker {

/// The nodes of a set that are inside by Γ: matched where it was, the mesh's elsewhere.
NodeMasks inside_by_gamma(const NodeMasks& set, const LineSigns& mesh, const MatchedVoxelization& matched);

/// The particles that no surface holds: outside by Γ at all corners of their cell, and farther than `reach` from the
/// mesh.
/// \param particles [m].
/// \param before the mesh that was voxelized.
/// \param matched what became of Γ; empty if nothing did.
/// \param mesh as it is now.
/// \param h Δx_Γ [m].
/// \param reach [m].
/// \return indices, increasing.
std::vector<std::uint32_t> find_uncovered_particles(const std::vector<Vec3f>& particles, const LineSigns& before,
                                                    const MatchedVoxelization& matched, const TriangleMesh& mesh,
                                                    double h, double reach);

}  // namespace particle_surface_tracker
