#include "cell_shape.h"

namespace particle_surface_tracker {

namespace {

CellShape::Face make_face(const Quad& normal, const Quad& corner, const Quad& first, const Quad& last) {
  const Quad from_last = cross(normal, last);
  return {corner, normal, {cross(normal, first), from_last}, dot(from_last, first)};
}

CellShape::Edge make_edge(const Quad& start, const Quad& along) {
  const float squared_length = dot(along, along);
  return {start, along, squared_length > 0.0f ? 1.0f / squared_length : 0.0f};
}

}  // namespace

void make_cell_shape(const SurfaceCells& cells, std::uint32_t cell, const openvdb::Coord& origin, CellShape& shape) {
  const SurfaceTriangulation& mesh = cells.surface().triangulation;
  shape.faces = 0;
  shape.edges = 0;
  shape.corners = 0;
  shape.normals = {};
  for (std::uint32_t t = mesh.cells[cell].first_triangle; t != mesh.cells[cell + 1].first_triangle; ++t) {
    const Triangle& vertices = mesh.triangles[t];
    Quad place[3];
    for (int i = 0; i < 3; ++i) {
      place[i] = cells.relative(vertices[i], origin);
      shape.corner[shape.corners++] = place[i];
      shape.normals.extend(cells.normals().around(vertices[i]));
    }
    const Quad along[3] = {place[1] - place[0], place[2] - place[1], place[0] - place[2]};
    const Quad& normal = cells.normals().normal(t);
    if (!is_zero(normal)) shape.face[shape.faces++] = make_face(normal, place[0], along[0], along[2]);
    for (int i = 0; i < 3; ++i) {
      if (vertices[i] < vertices[(i + 1) % 3]) shape.edge[shape.edges++] = make_edge(place[i], along[i]);
    }
  }
}

}  // namespace particle_surface_tracker
