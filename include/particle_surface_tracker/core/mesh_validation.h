#pragma once

#include <string>
#include <vector>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// Says in words what keeps a mesh from being a closed, consistently oriented 2-manifold of finite positions: no
/// triangles, indices without a vertex, positions that are not finite, degenerate triangles (two equal indices), unused
/// vertices, open, non-manifold and flipped edges, non-manifold vertices, duplicate triangles. Each kind comes with its
/// number and its first place (index and position).
/// \return an empty text if nothing is wrong.
std::string describe_mesh_defects(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles);

/// Checks that a mesh is a closed, consistently oriented 2-manifold of finite positions without degenerate triangles,
/// duplicate triangles or unused vertices.
/// \throw MeshError with the text of describe_mesh_defects() otherwise.
void check_closed_manifold(const TriangleMesh& mesh);

/// Turns components of a closed manifold mesh so that solids have positive volume: an outermost component of negative
/// volume is turned together with everything nested in it, so that cavities stay cavities.
///
/// A nested component keeps its sense relative to the one around it. If both have the same sense (a solid directly
/// inside a solid, a cavity directly inside a cavity), nothing tells which of them is wrong: they are left and a line
/// says so.
/// \return one line of text for every component that was turned and for every one nested with the wrong sense.
std::vector<std::string> orient_outward(TriangleMesh& mesh);

}  // namespace particle_surface_tracker
