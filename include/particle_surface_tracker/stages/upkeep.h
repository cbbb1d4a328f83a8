#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/mesh_twins.h"
#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// What keep_up() did.
struct UpkeepReport {
  std::size_t splits = 0;            ///< Of long edges.
  std::size_t collapses = 0;         ///< Of short edges.
  std::size_t fold_collapses = 0;    ///< Of folded edges.
  std::size_t sliver_collapses = 0;  ///< Of the shortest edges of slivers.
  std::size_t flips = 0;             ///< Of the longest edges of slivers.
  std::size_t refused = 0;           ///< Edges and triangles beyond a limit that no operation could mend.

  /// Vertices whose position is new or has changed: increasing indices. Their δ is only a blend and must be measured.
  std::vector<std::uint32_t> fresh;

  /// Whether the connectivity of the mesh has changed.
  bool has_changes() const { return splits + collapses + fold_collapses + sliver_collapses + flips > 0; }
};

/// Memory that can be kept between calls of keep_up(), so that a call with nothing to do allocates nothing. It never
/// changes a result, whatever mesh it was used for before.
struct UpkeepMemory {
  MeshTwins twins;                                   ///< As far as known.
  std::vector<std::vector<std::uint32_t>> suspects;  ///< Triangles with something to mend, in each block of them.
};

/// Keeps the triangles of a mesh that moves in shape (Sec. 8): splits long edges, longest first; collapses short ones,
/// shortest first; collapses folded edges; flips or collapses slivers.
///
/// Only what is bad and clearly worse than at birth is touched (docs/upkeep.md), so that a mesh at rest keeps every
/// bit. A vertex is born when it is first seen here or by note_birth(). Untouched vertices keep their position, id,
/// attributes and order; those of new vertices are blended.
/// \param mesh closed and manifold; so it stays, and every component keeps at least a tetrahedron.
/// \throw MeshError if the mesh is not closed, oriented and manifold.
UpkeepReport keep_up(TriangleMesh& mesh, const Parameters& parameters, UpkeepMemory& memory);
UpkeepReport keep_up(TriangleMesh& mesh, const Parameters& parameters);

/// Notes the edges, angles and folds around every vertex that has none noted yet, as those of its birth.
/// \throw MeshError if the mesh is not closed, oriented and manifold.
void note_birth(TriangleMesh& mesh);

/// Makes these vertices new ones that re-meshing has made: the next note_birth() or keep_up() measures them anew. They
/// carry no detail of the first mesh, so that edges between them may be collapsed for being small alone.
void mark_as_remeshed(TriangleMesh& mesh, const std::vector<std::uint32_t>& vertices);

/// Lets δ decay exponentially with the half-life of the parameters, where there is one.
/// \param elapsed_seconds since the last call [s]; nothing happens unless it is positive.
void decay_delta(TriangleMesh& mesh, double elapsed_seconds, const Parameters& parameters);

}  // namespace particle_surface_tracker
