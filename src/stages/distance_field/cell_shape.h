#pragma once

#include <cstdint>

#include "normal_boxes.h"
#include "surface_cells.h"
#include "triangle_shape.h"

namespace particle_surface_tracker {

/// The triangles of one cut cell.
struct CellShape {
  int triangles = 0;
  const TriangleShape* triangle = nullptr;
  int edges = 0;  ///< Each edge of the isosurface belongs to one of its two triangles only.
  const Quad* edge[3 * kMostCellTriangles + 1];
  NormalBox normals;  ///< Of all triangles around the corners.
};

/// \param shapes of the triangles of the cell.
void make_cell_shape(const SurfaceCells& cells, std::uint32_t cell, const TriangleShape* shapes, CellShape& shape);

}  // namespace particle_surface_tracker
