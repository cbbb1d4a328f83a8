#pragma once

#include <cstdint>

#include "birth_record.h"
#include "particle_surface_tracker/core/parameters.h"
#include "triangle_shape.h"

namespace particle_surface_tracker {

/// Which edges and triangles call for an operation (Sec. 8): only those that are bad, and clearly worse than at birth.
class Tolerances {
 public:
  Tolerances(const BirthRecords& births, const Parameters& parameters);

  /// An edge longer than this is split [m].
  double longest_edge(std::uint32_t a, std::uint32_t b) const;
  /// An edge shorter than this is collapsed [m].
  double shortest_edge(std::uint32_t a, std::uint32_t b) const;
  /// The angle that an edge must be folded by to be collapsed, whatever its birth [rad].
  double fold_angle() const { return fold_angle_; }

  bool is_long(std::uint32_t a, std::uint32_t b, double squared_length) const;

  /// Short, or with both ends at the same place: the latter at any age, since readers of files weld by position.
  bool is_short(std::uint32_t a, std::uint32_t b, double squared_length) const;

  /// \param normal, other_normal area_normal() of the two triangles at the edge.
  bool is_folded(std::uint32_t a, std::uint32_t b, const Vec3d& normal, const Vec3d& other_normal) const;

  /// \param sine sine_of_smallest_angle().
  bool is_sliver(const Triangle& triangle, double sine) const;

 private:
  const BirthRecords& births_;
  double split_length_;
  double split_growth_;
  double collapse_length_;
  double collapse_shrinkage_;
  double fold_angle_;
  double cosine_of_fold_angle_;
  double sine_of_sliver_angle_;
};

}  // namespace particle_surface_tracker
