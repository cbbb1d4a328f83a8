#pragma once

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include <openvdb/Types.h>
#include <boost/multiprecision/gmp.hpp>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker::test {

/// The lattice of Γ by rational numbers and brute force: the mesh is moved by three numbers so small and so different
/// that they have the effect of (εx, εy, εz), and then everything is computed as if there were no special cases.
///
/// Good for coordinates that are multiples of 2⁻³⁵ m below 2³⁵ m.
class ExactLattice {
 public:
  using Number = boost::multiprecision::mpq_rational;
  using Point = std::array<Number, 3>;

  /// What a point of the cut is: on a lattice edge a triangle, on a lattice face a mesh edge.
  struct PointName {
    bool is_on_face;
    int axis;
    openvdb::Coord node;
    std::uint32_t a;
    std::uint32_t b;
    friend bool operator<(const PointName& p, const PointName& q) {
      return std::tie(p.is_on_face, p.axis, p.node, p.a, p.b) < std::tie(q.is_on_face, q.axis, q.node, q.a, q.b);
    }
    friend bool operator==(const PointName& p, const PointName& q) {
      return std::tie(p.is_on_face, p.axis, p.node, p.a, p.b) == std::tie(q.is_on_face, q.axis, q.node, q.a, q.b);
    }
  };

  struct Segment {
    int axis;
    openvdb::Coord face;
    PointName from;
    PointName to;
    friend bool operator<(const Segment& p, const Segment& q) {
      return std::tie(p.axis, p.face, p.from, p.to) < std::tie(q.axis, q.face, q.from, q.to);
    }
    friend bool operator==(const Segment& p, const Segment& q) {
      return std::tie(p.axis, p.face, p.from, p.to) == std::tie(q.axis, q.face, q.from, q.to);
    }
  };

  struct Crossing {
    int axis;
    openvdb::Coord node;
    std::uint32_t triangle;
    int step;
    Number place;  ///< Coordinate along the axis [m].
  };

  ExactLattice(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles, double h);

  openvdb::Coord cell(std::uint32_t vertex) const;

  /// Crossings of one triangle and all lattice edges, sorted by axis and node.
  std::vector<Crossing> crossings(std::uint32_t triangle) const;

  /// Segments of one triangle, sorted.
  std::vector<Segment> segments(std::uint32_t triangle) const;

  /// Where a mesh edge from a to b crosses plane k, as a share of its length.
  Number share(std::uint32_t a, std::uint32_t b, int axis, std::int32_t k) const;

 private:
  Number plane(std::int32_t k) const;
  std::int32_t cell_along(const Number& x) const;
  Number normal(std::uint32_t triangle, int axis) const;
  void append_segments(std::uint32_t triangle, int axis, std::int32_t k, std::vector<Segment>& segments) const;

  const std::vector<Triangle>& triangles_;
  double h_;
  std::vector<Point> points_;
};

}  // namespace particle_surface_tracker::test
