#pragma once

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/mesh_measures.h"
#include "particle_surface_tracker/stages/remeshing.h"
#include "sequences/mesh_judge.h"

namespace particle_surface_tracker::test {

inline RemeshingReport remesh_at(TriangleMesh& mesh, double h, const RemeshingRequest& request = {}) {
  const MeshLattice lattice(mesh.positions(), mesh.triangles(), h);
  return remesh(mesh, lattice, request);
}

inline void expect_sound(const TriangleMesh& mesh) {
  EXPECT_TRUE(test::find_surface_defects(mesh.vertex_count(), mesh.triangles()).none());
}

inline MeshMeasures measures_of(const TriangleMesh& mesh) {
  return measure_mesh(mesh.positions(), mesh.triangles());
}

inline void expect_same(const TriangleMesh& mesh, const TriangleMesh& before) {
  EXPECT_EQ(mesh.positions(), before.positions());
  EXPECT_EQ(mesh.triangles(), before.triangles());
  EXPECT_EQ(mesh.ids(), before.ids());
  EXPECT_EQ(mesh.delta(), before.delta());
}

}  // namespace particle_surface_tracker::test
