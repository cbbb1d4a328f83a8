#pragma once

#include <cstdint>
#include <vector>

#include <openvdb/Types.h>

#include "leaf_index.h"
#include "normal_spread.h"
#include "particle_surface_tracker/core/implicit_surface.h"

namespace particle_surface_tracker {

/// What is known of the triangles of one cut cell without looking at them. Coordinates in cells, relative to the corner
/// of the cell's leaf.
///
/// The points whose closest place on the isosurface is in the cell are in a tube along the cell's normal that widens
/// with the height over the cell, to both sides: if the closest place is inside a triangle, the point is over it along
/// its normal; if it is on an edge or a vertex, the direction to the point is in the spherical polygon of the normals
/// around that place, so it leans no farther from the cell's normal than the farthest of them.
struct CellBounds {
  static constexpr float unbounded = -1.0f;

  Vec3f center;  ///< Of the box around the triangles.
  Vec3f normal;  ///< Unit, a mean.
  float radius;  ///< The triangles are within this of the center.
  float height;  ///< They are within this of the plane through the center across the normal.
  float slope;  ///< Tangent of the largest angle between the normal and one around the cell's vertices, or `unbounded`.

  int axis;        ///< The lattice axis closest to the normal. Of the other two, in order:
  float shear[2];  ///< what the normal moves along them from slice to slice across the first one,
  float low[2];    ///< and the interval of the triangles, moved along the normal into slice 0.
  float high[2];
  float bottom;  ///< The interval of the triangles along the first one.
  float top;
};

/// The cut cells of an isosurface, ready for questions about distances.
class SurfaceCells {
 public:
  /// The cells of one leaf of 8³.
  struct Leaf {
    openvdb::Coord origin;
    std::uint32_t begin, end;
  };

  explicit SurfaceCells(const ImplicitSurface& surface);

  const ImplicitSurface& surface() const { return surface_; }
  const std::vector<Leaf>& leaves() const { return leaves_; }
  const CellBounds& bounds(std::uint32_t cell) const { return bounds_[cell]; }
  const Vec3f& normal(std::uint32_t triangle) const { return normals_.normal(triangle); }

  /// Number of the leaf with that origin, or LeafIndex::none.
  std::uint32_t find(const openvdb::Coord& origin) const { return index_.find(origin); }

  /// A vertex of the triangulation relative to a node, in cells.
  Vec3f relative(std::uint32_t vertex, const openvdb::Coord& node) const {
    const Vec3d place = surface_.triangulation.vertices[vertex].cast<double>() * per_meter_;
    return Vec3d(place.x() - node.x(), place.y() - node.y(), place.z() - node.z()).cast<float>();
  }

 private:
  CellBounds make_bounds(std::uint32_t cell) const;

  const ImplicitSurface& surface_;
  double per_meter_;
  NormalSpread normals_;
  std::vector<Leaf> leaves_;
  LeafIndex index_;
  std::vector<CellBounds> bounds_;
};

}  // namespace particle_surface_tracker
