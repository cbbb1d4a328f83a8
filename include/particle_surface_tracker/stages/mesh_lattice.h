#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <tuple>
#include <vector>

#include <openvdb/Types.h>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

class NodeMasks;

// Where the explicit mesh meets the lattice of Γ (Sec. 6). Node (i, j, k) is at (fl(i·h), fl(j·h), fl(k·h)) [m], h =
// Δx_Γ; cell c has its lowest corner at node c.
//
// Every answer but `place` is exact for the mesh moved by (εx, εy, εz), εx ≫ εy ≫ εz > 0 and all smaller than any
// number: one motion for the whole mesh, so that no two answers contradict each other and no vertex, edge or triangle
// ever touches a node, a lattice edge or a plane that it should cross. A triangle that is degenerate seen along an axis
// is crossed by no lattice line along it.

/// The lattice edge from a node to the next one along an axis.
struct LatticeEdge {
  openvdb::Coord node;
  std::uint8_t axis = 0;
};

/// The unit square across an axis whose lowest corner is a node. It lies between the cell `node` (the upper one) and
/// the one before it along the axis (the lower one).
struct LatticeFace {
  openvdb::Coord node;
  std::uint8_t axis = 0;

  openvdb::Coord upper_cell() const { return node; }
  openvdb::Coord lower_cell() const {
    return node.offsetBy(axis == 0 ? -1 : 0, axis == 1 ? -1 : 0, axis == 2 ? -1 : 0);
  }
};

/// A triangle crosses a lattice edge.
struct EdgeCrossing {
  LatticeEdge edge;
  std::uint32_t triangle = 0;
  std::int8_t step = 0;  ///< Change of the winding number along the axis: +1 enters the liquid, −1 leaves it.
  double place = 0.0;    ///< Along the edge, in [0, 1]; rounded, never to be decided upon.
};

/// A point where mesh and lattice meet. What it is follows from kind, node, axis, a and b alone; operator== and the
/// hash look at nothing else.
struct LatticePoint {
  enum class Kind : std::uint8_t {
    kOnLatticeEdge,  ///< A triangle crosses a lattice edge.
    kOnLatticeFace,  ///< A mesh edge crosses a lattice face.
  };
  Kind kind = Kind::kOnLatticeEdge;
  std::uint8_t axis = 0;  ///< Of the lattice edge or face.
  std::int8_t step =
      0;  ///< kOnLatticeEdge: as in EdgeCrossing. kOnLatticeFace: +1 if from a to b is towards +axis, else −1.
  openvdb::Coord node;  ///< Of the lattice edge or face.
  std::uint32_t a = 0;  ///< kOnLatticeEdge: the triangle. kOnLatticeFace: the lower vertex of the mesh edge.
  std::uint32_t b = 0;  ///< kOnLatticeEdge: 0. kOnLatticeFace: the higher vertex of the mesh edge.
  double place = 0.0;   ///< In [0, 1] along the lattice edge, or along the mesh edge from a to b; rounded.
};

/// What the lattice cuts one triangle into.
struct TriangleCut {
  /// Where the triangle meets a face. It meets a face in one segment or not at all.
  struct Segment {
    LatticeFace face;
    std::uint32_t from = 0;  ///< Index into points. Seen from the triangle's front (outside) the lower cell of the face
    std::uint32_t to = 0;    ///< is on the left of the way from → to.
  };

  std::vector<LatticePoint> points;     ///< Each once. One on a lattice edge ends four segments, one on a face one.
  std::vector<Segment> segments;        ///< Together with the triangle's own edges, the outlines of all its pieces.
  std::array<openvdb::Coord, 3> cells;  ///< That hold the triangle's three vertices.
};

/// A piece of a sorted array.
template <typename T>
class ArrayRange {
 public:
  ArrayRange() = default;
  ArrayRange(const T* begin, const T* end) : begin_(begin), end_(end) {}
  const T* begin() const { return begin_; }
  const T* end() const { return end_; }
  std::size_t size() const { return static_cast<std::size_t>(end_ - begin_); }
  bool empty() const { return begin_ == end_; }
  const T& operator[](std::size_t n) const { return begin_[n]; }

 private:
  const T* begin_ = nullptr;
  const T* end_ = nullptr;
};

/// Where a mesh meets the lattice of Γ. Safe to ask from several threads at once; the same for any number of threads.
class MeshLattice {
 public:
  /// Takes time and memory by the number of cells that the mesh passes through.
  /// \param positions [m], and \param triangles must outlive this object and stay as they are.
  /// \param h cell size Δx_Γ [m].
  /// \throw MeshError if a position is not finite or 2³⁰ cells or more from the origin of the world, if a triangle names
  /// a vertex that is not there, or if the mesh passes through more than 2³¹ cells.
  /// \throw ParameterError if h is not between 1e-30 and 1e30 m.
  MeshLattice(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles, double h);
  ~MeshLattice();
  MeshLattice(MeshLattice&& other) noexcept;
  MeshLattice& operator=(MeshLattice&& other) noexcept;

  double h() const;
  const std::vector<Vec3f>& positions() const;
  const std::vector<Triangle>& triangles() const;

  /// Coordinate of node k along any axis: fl(k·h) [m].
  double plane(std::int32_t k) const { return static_cast<double>(k) * h(); }

  /// All crossings of triangles and lattice edges, by edge, and along the edge where they are apart. Crossings in one
  /// place: those that enter first, then by triangle.
  const std::vector<EdgeCrossing>& crossings() const;

  /// The crossings of one lattice edge, a part of crossings().
  ArrayRange<EdgeCrossing> crossings_on(const LatticeEdge& edge) const;

  /// How often the mesh winds around a node, anywhere in space: inside is ≥ 1. Of a closed mesh it is the same along
  /// every axis.
  /// \param axis of the lattice line on which the crossings below the node are counted.
  int winding_number(const openvdb::Coord& node, int axis = 2) const;

  /// Increasing indices of triangles near a cell: all that meet it, and perhaps others whose bounding box does.
  ArrayRange<std::uint32_t> triangles_in_cell(const openvdb::Coord& cell) const;

  /// Cells for which triangles_in_cell() is not empty, in an order that depends on the mesh only.
  std::vector<openvdb::Coord> cells() const;

  /// The same without the cells of a set.
  std::vector<openvdb::Coord> cells_outside(const NodeMasks& set) const;

  /// The cell that a vertex is in.
  openvdb::Coord cell_of_vertex(std::uint32_t vertex) const;

  /// Cuts a triangle along the planes of the lattice.
  TriangleCut cut_triangle(std::uint32_t triangle) const;

  /// The same, into an object whose memory is used again.
  void cut_triangle(std::uint32_t triangle, TriangleCut& cut) const;

  /// Order of two points on lattice faces that lie on the same mesh edge, from a to b. Only equal points are in one
  /// place.
  bool comes_before(const LatticePoint& p, const LatticePoint& q) const;

 private:
  struct Data;
  std::unique_ptr<const Data> data_;
};

/// Γ: distances of nodes to the mesh, exact up to rounding, at most `reach`. Below 0 exactly where the winding number
/// is ≥ 1, also at nodes on the mesh.
/// \param reach [m]; the time grows with the cells within it.
/// \return one distance [m] per node.
std::vector<float> signed_distances(const MeshLattice& lattice, const std::vector<openvdb::Coord>& nodes, double reach);

/// By axis, then by lattice line, then along it.
inline bool operator<(const LatticeEdge& p, const LatticeEdge& q) {
  if (p.axis != q.axis) return p.axis < q.axis;
  const int first = (p.axis + 1) % 3;
  const int second = (p.axis + 2) % 3;
  return std::make_tuple(p.node[first], p.node[second], p.node[p.axis]) <
         std::make_tuple(q.node[first], q.node[second], q.node[q.axis]);
}

inline bool operator==(const LatticeEdge& p, const LatticeEdge& q) {
  return p.axis == q.axis && p.node == q.node;
}

inline bool operator!=(const LatticeEdge& p, const LatticeEdge& q) {
  return !(p == q);
}

/// By axis, then by node.
inline bool operator<(const LatticeFace& p, const LatticeFace& q) {
  return std::tie(p.axis, p.node) < std::tie(q.axis, q.node);
}

inline bool operator==(const LatticeFace& p, const LatticeFace& q) {
  return p.axis == q.axis && p.node == q.node;
}

inline bool operator!=(const LatticeFace& p, const LatticeFace& q) {
  return !(p == q);
}

inline bool operator<(const LatticePoint& p, const LatticePoint& q) {
  return std::tie(p.kind, p.axis, p.node, p.a, p.b) < std::tie(q.kind, q.axis, q.node, q.a, q.b);
}

inline bool operator==(const LatticePoint& p, const LatticePoint& q) {
  return std::tie(p.kind, p.axis, p.node, p.a, p.b) == std::tie(q.kind, q.axis, q.node, q.a, q.b);
}

inline bool operator!=(const LatticePoint& p, const LatticePoint& q) {
  return !(p == q);
}

/// Hash of lattice edges, faces and points, for std::unordered_map.
struct LatticeHash {
  std::size_t operator()(const LatticeEdge& edge) const { return mixed(edge.node, edge.axis); }
  std::size_t operator()(const LatticeFace& face) const { return mixed(face.node, face.axis); }
  std::size_t operator()(const LatticePoint& point) const {
    const auto parts = std::uint64_t{point.a} << 32 | point.b;
    return mixed(point.node, parts * 8 + static_cast<std::uint64_t>(point.kind) * 4 + point.axis);
  }

 private:
  static std::size_t mixed(const openvdb::Coord& node, std::uint64_t h) {
    for (int axis = 0; axis < 3; ++axis) {
      h = (h ^ static_cast<std::uint32_t>(node[axis])) * 0x9E3779B97F4A7C15ull;
      h ^= h >> 32;
    }
    return static_cast<std::size_t>(h);
  }
};

}  // namespace particle_surface_tracker
