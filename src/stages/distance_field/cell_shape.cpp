#include "cell_shape.h"

namespace particle_surface_tracker {

void make_cell_shape(const SurfaceCells& cells, std::uint32_t cell, const TriangleShape* shapes, CellShape& shape) {
  const SurfaceTriangulation& mesh = cells.surface().triangulation;
  const std::uint32_t begin = mesh.cells[cell].first_triangle;
  shape.triangles = static_cast<int>(mesh.cells[cell + 1].first_triangle - begin);
  shape.triangle = shapes;
  NormalBox normals;
  int edges = 0;
  for (int t = 0; t < shape.triangles; ++t) {
    const Triangle& vertices = mesh.triangles[begin + t];
    for (int i = 0; i < 3; ++i) {
      normals.extend(cells.normals().around(vertices[i]));
      // Writes every edge and steps on only where it counts: cheaper than branches that are hard to predict.
      shape.edge[edges] = shapes[t].edge(i);
      edges += static_cast<int>(vertices[i] < vertices[(i + 1) % 3]);
    }
  }
  shape.edges = edges;
  shape.normals = normals;
}

}  // namespace particle_surface_tracker
