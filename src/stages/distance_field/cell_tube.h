#pragma once

#include "cell_shape.h"

namespace particle_surface_tracker {

/// Where the nodes are whose closest place on the isosurface is in a cell: in each slice of nodes across a lattice axis
/// within a rectangle.
///
/// From its closest place c such a node is in a direction that is in the spherical polygon of the normals around c: if
/// c is inside a triangle, the direction is the triangle's normal or its opposite. If m is any sum of these normals and
/// a the axis across the slices, the node in slice s is at c + (s − c_a) m / m_a, and along another axis b the ratio
/// m_b / m_a is between the least and the largest of the box of the normals.
struct CellTube {
  int slice;          ///< The axis across the slices.
  int side[2];        ///< The other two, in order.
  float first, last;  ///< Slices.
  float least[2];     ///< Along each of the other two, no node is below this,
  float most[2];      ///< nor above this;
  Quad ratio;         ///< and in slice s it is between the smaller of low[k] + s · ratio[k]
  Quad low;           ///< and the larger of high[k] + s · ratio[k], where k is 0 and 1 for the first of them,
  Quad high;          ///< 2 and 3 for the second.
};

/// \param height distance from the isosurface up to which the nodes are wanted [cells].
CellTube make_cell_tube(const CellShape& shape, float height);

}  // namespace particle_surface_tracker
