#pragma once

#include <string>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// Name of an attribute of three components that is written as normals.
constexpr const char* normal_attribute = "normal";

/// Writes a mesh as binary little-endian PLY: x y z, then delta, id, colour (red green blue alpha, uchar) and texture
/// coordinates (s t, the names that Blender writes and reads) where present, normals (nx ny nz), then every other
/// attribute under its name (name_0, name_1, … with several components). The file appears whole under its name or not
/// at all: it is written beside it as `path`.part and renamed.
/// \throw OutputError if it cannot be written (folder missing, read-only, disk full); nothing is left behind then.
void write_ply(const std::string& path, const TriangleMesh& mesh);

/// Writes a mesh as Wavefront OBJ (positions with 9 digits so that floats survive; colours after the position, vt where
/// present). As whole as write_ply().
/// \throw OutputError as write_ply().
void write_obj(const std::string& path, const TriangleMesh& mesh);

}  // namespace particle_surface_tracker
