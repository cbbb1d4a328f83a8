#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker::test {

/// Answers where points are relative to a closed triangle mesh: exact signs, distances by CGAL. Shares no code with the
/// library. Safe to ask from several threads at once.
class SolidJudge {
 public:
  SolidJudge(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles);
  SolidJudge(SolidJudge&&) noexcept;
  ~SolidJudge();

  /// How often the mesh winds around a point: above 0 inside, also where parts of the mesh overlap each other; 0
  /// outside and in cavities. A point on the surface may get either.
  int winding_number(const Vec3d& point) const;
  int winding_number(const Vec3f& point) const { return winding_number(point.cast<double>().eval()); }

  /// A triangle that a ray upwards from a point passes: +1 where it leaves through the front, −1 where it enters.
  struct Crossing {
    std::uint32_t triangle;
    int sign;
  };

  /// What the ray upwards from a point crosses; their sum is winding_number(), their sum over the triangles of a
  /// component how often that winds around the point.
  std::vector<Crossing> crossings_above(const Vec3d& point) const;

  struct Nearest {
    double distance;  ///< [m].
    std::uint32_t triangle;
  };

  /// The nearest triangle of a mesh that has one.
  Nearest nearest(const Vec3f& point) const;

  /// Unsigned distance to the nearest triangle [m].
  double distance(const Vec3d& point) const;

  /// Share of the points that are inside the mesh or at most `tolerance` [m] away from it.
  double covered_share(const std::vector<Vec3f>& points, double tolerance) const;

 private:
  struct Tree;
  struct Columns;
  std::unique_ptr<Tree> tree_;
  std::unique_ptr<Columns> columns_;
};

}  // namespace particle_surface_tracker::test
