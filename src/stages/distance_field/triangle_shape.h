#pragma once

#include <cstdint>

#include "particle_surface_tracker/core/implicit_surface.h"
#include "quad.h"

namespace particle_surface_tracker {

/// v · (p, 1) for a place p.
using Form = Quad;

/// A triangle of the isosurface, as what the distance of a node p takes. Coordinates in cells, relative to the corner
/// of a leaf.
struct TriangleShape {
  /// The parts: for each edge, from each corner to the next, its start, what leads from there to its end, and a form.
  /// The place of the edge closest to p is start + t along, where t is the number in [0, 1] that is closest to
  /// parameter · (p, 1); the parameter is 0 if the edge has no length. If no side · (p, 1) is negative, p is over the
  /// triangle, and its distance is |height · (p, 1)|; triangles so thin that their normal is rounding have a side that
  /// always is.
  enum Part { kEdges = 0, kSides = 9, kHeight = 12, kParts = 13 };
  enum EdgePart { kStart, kAlong, kParameter, kEdgeParts };

  Quad part[kParts];

  const Quad* edge(int n) const { return part + kEdgeParts * n; }
  const Quad& corner(int n) const { return edge(n)[kStart]; }
  const Form& side(int n) const { return part[kSides + n]; }
  const Form& height() const { return part[kHeight]; }
};

/// Part of a triangulation and where to look at it from.
struct TriangleRange {
  const SurfaceTriangulation* mesh;
  std::uint32_t begin, end;  ///< Of the triangles.
  double per_meter;          ///< [cells / m]
  openvdb::Coord origin;     ///< Of the leaf [cells].
};

/// The loops over triangles, compiled for one set of instructions.
struct TriangleKernel {
  /// Triangles that are made at a time: so many more may be written beyond the end.
  static constexpr std::uint32_t lanes = 16;

  /// The shapes of the triangles of a range.
  void (*make_shapes)(const TriangleRange& range, TriangleShape* shapes);

  /// Their unit normals, outward; zero if a triangle is a segment or a point.
  void (*make_normals)(const TriangleRange& range, Quad* normals);
};

/// The kernel for the active set of instructions.
const TriangleKernel& active_triangle_kernel();

}  // namespace particle_surface_tracker
