#pragma once

#include <string>
#include <vector>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// A mesh as it was read, and what was done to it on the way.
struct LoadedMesh {
  TriangleMesh mesh;
  std::vector<std::string> warnings;  ///< Turned components, merged doubles, lost texture seams, in words.
};

/// Reads the initial mesh from PLY, OFF (known by their content), OBJ or STL (known by their extension) and makes it
/// fit to be tracked: a mesh that is inside out is turned (per outermost component; cavities nested in it keep their
/// sense), polygons are cut into triangles, colours and texture coordinates become attributes where present.
///
/// Vertices keep their order, and positions their bits; numbers in text are rounded to the nearest float (in text STL,
/// which assimp reads, numbers with an exponent may miss it by one). Vertices doubled by the format are merged, but
/// only if the mesh is not closed and manifold without that: parts that touch in a point stay apart.
/// \throw InputError if the file is missing, unreadable, damaged or holds no triangles.
/// \throw MeshError as check_closed_manifold().
LoadedMesh read_initial_mesh(const std::string& path);

}  // namespace particle_surface_tracker
