#pragma once

#include <cstdint>

#include "normal_boxes.h"
#include "surface_cells.h"

namespace particle_surface_tracker {

/// The triangles of one cut cell, as what the distance of a node p takes. Coordinates in cells, relative to the corner
/// of the cell's leaf.
struct CellShape {
  static constexpr int max_faces = 12;
  static constexpr int max_corners = 3 * max_faces;

  /// p is over the triangle if side[0] · w ≥ 0, side[1] · w ≥ 0, and their sum is at most twice_area, where
  /// w = p − corner; then its distance is |normal · w|.
  struct Face {
    Quad corner;
    Quad normal;
    Quad side[2];
    float twice_area;
  };

  struct Edge {
    Quad start;
    Quad along;                    ///< To its end.
    float inverse_squared_length;  ///< 0 if it has no length.
  };

  int faces = 0;    ///< Triangles so thin that their normal is rounding have edges but no face.
  int edges = 0;    ///< Each edge of the isosurface belongs to one of its two triangles only.
  int corners = 0;  ///< Three of each triangle.
  Face face[max_faces];
  Edge edge[max_corners];
  Quad corner[max_corners];
  NormalBox normals;  ///< Of all triangles around the corners.
};

/// \param origin of the cell's leaf [cells].
void make_cell_shape(const SurfaceCells& cells, std::uint32_t cell, const openvdb::Coord& origin, CellShape& shape);

}  // namespace particle_surface_tracker
