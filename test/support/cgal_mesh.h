#pragma once

#include <cstdint>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker::test {

using CgalKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalMesh = CGAL::Surface_mesh<CgalKernel::Point_3>;

/// The positions and triangles of a mesh, for CGAL as a judge.
inline CgalMesh to_cgal(const TriangleMesh& mesh) {
  CgalMesh result;
  for (const Vec3f& p : mesh.positions()) result.add_vertex(CgalKernel::Point_3(p.x(), p.y(), p.z()));
  const auto vertex = [](std::uint32_t v) { return CgalMesh::Vertex_index(v); };
  for (const auto& [a, b, c] : mesh.triangles()) result.add_face(vertex(a), vertex(b), vertex(c));
  return result;
}

}  // namespace particle_surface_tracker::test
