#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/mesh_measures.h"
#include "particle_surface_tracker/io/mesh_reader.h"
#include "support/temporary_folder.h"

namespace particle_surface_tracker::test {

inline LoadedMesh load(const std::string& name, const std::string& content) {
  const TemporaryFolder folder;
  return read_initial_mesh(folder.write(name, content));
}

template <typename Error>
std::string error_of(const std::string& name, const std::string& content) {
  try {
    load(name, content);
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << name << " was accepted";
  return "";
}

inline double volume_of(const TriangleMesh& mesh) {
  return measure_mesh(mesh.positions(), mesh.triangles()).volume;
}

inline const std::vector<float>& values_of(const TriangleMesh& mesh, const char* name) {
  return mesh.attributes()[mesh.attributes().find(name)].values;
}

inline constexpr const char* kTetrahedronObj =
    "# a comment\nmtllib none.mtl\no thing\n"
    "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 2 4 3\nf 2/1/1 3//2 5\nusemtl other\nf -3 -2 -1\nf 2 5 4\n";

inline constexpr const char* kCubeOff =
    "OFF\n# comment\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 0 3 2 1\n4 4 5 6 7 255 0 0\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

inline constexpr const char* kTetrahedronPly =
    "ply\nformat ascii 1.0\ncomment of no meaning\nelement vertex 4\n"
    "property double x\nproperty float y\nproperty float z\nproperty float delta\nproperty uint id\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float u\nproperty float v\n"
    "element face 4\nproperty uchar flag\nproperty list uchar int vertex_index\n"
    "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
    "0 0 0 0.5 7 255 0 0 0 0\n1 0 0 -0.5 8 0 255 0 1 0\n0 1 0 0.5 9 0 0 51 0 1\n0 0 1 0.5 10 255 255 255 1 0.5\n"
    "1 3 0 2 1\n0 3 0 1 3\n0 3 1 2 3\n0 3 2 0 3\n0 1\n";

}  // namespace particle_surface_tracker::test
