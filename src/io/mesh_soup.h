#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// A mesh as a file holds it: polygons of any size, in the order of the file, nothing checked but that the file is
/// whole.
struct MeshSoup {
  std::vector<Vec3f> positions;
  std::vector<std::array<float, 4>> colors;            ///< Of every vertex, in [0, 1]; or empty.
  std::vector<std::array<float, 2>> texcoords;         ///< Of every vertex; or empty.
  std::vector<std::uint32_t> corners;                  ///< Vertices of all polygons, polygon by polygon.
  std::vector<std::size_t> polygon_ends;               ///< One past the last corner of each polygon.
  std::vector<std::array<float, 2>> corner_texcoords;  ///< Of every corner, NaN where there are none; or empty.
  bool has_indices = true;                             ///< False where every face has vertices of its own.
};

/// Reads PLY, OFF (known by their content), OBJ or STL (known by their extension).
/// \throw InputError that names the path if the file is missing, unreadable or damaged.
MeshSoup read_mesh_soup(const std::string& path);

// Each takes the content of a file.
// PLY, OFF and OBJ are read here and not by assimp 5.2, which never returns from, or crashes in, truncated PLY and OFF
// files, gives every corner of an OBJ face its own vertex in the order of the faces, and misses the nearest float of
// numbers with an exponent. What it reads safely is left to it.

/// \throw InputError if the text or the binary data is damaged or ends early.
MeshSoup parse_ply(const std::string& content);

/// \throw InputError as parse_ply().
MeshSoup parse_off(const std::string& content);

/// \throw InputError as parse_ply().
MeshSoup parse_obj(const std::string& content);

/// Reads what assimp knows; `extension` ("stl") helps it to recognise the format.
/// \throw InputError with assimp's words.
MeshSoup parse_with_assimp(const std::string& content, const std::string& extension);

/// Cuts all polygons into triangles, fans around the corner that suits best; polygons of fewer than three corners
/// vanish.
/// \throw InputError if a polygon names a vertex that is not there.
std::vector<Triangle> triangulate(const MeshSoup& soup);

/// Turns texture coordinates of corners into texture coordinates of vertices: the first corner of a vertex wins.
/// \return the number of vertices whose corners disagree (texture seams).
std::size_t move_texcoords_to_vertices(MeshSoup& soup);

/// Joins vertices of the same position (−0 is 0) into the first of them; all others keep their order.
/// \param seams receives the number of vertices that lose texture coordinates of their own.
/// \return the number of vertices that went.
std::size_t merge_equal_positions(MeshSoup& soup, std::size_t& seams);

}  // namespace particle_surface_tracker
