#pragma once

#include <algorithm>
#include <array>
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

  bool is_long(std::uint32_t a, std::uint32_t b, double squared_length) const {
    if (squared_length <= split_length_ * split_length_) return false;
    const double limit = longest_edge(a, b);
    return squared_length > limit * limit;
  }

  /// Short, or with both ends at the same place: the latter at any age, since readers of files weld by position.
  bool is_short(std::uint32_t a, std::uint32_t b, double squared_length) const {
    if (squared_length >= squared_longest_short_edge_) return false;
    const double limit = shortest_edge(a, b);
    return squared_length < limit * limit || squared_length == 0.0;
  }

  /// \param normal, other_normal area_normal() of the two triangles at the edge.
  bool is_folded(std::uint32_t a, std::uint32_t b, const Vec3d& normal, const Vec3d& other_normal) const {
    // The sign settles nearly all edges.
    const double dot = normal.dot(other_normal);
    return dot < 0.0 && is_folded_back(a, b, normal, other_normal, dot);
  }

  /// False only where is_sliver() is; cheaper.
  /// \param normal area_normal()
  /// \param squares squared_lengths()
  bool may_be_sliver(const Vec3d& normal, const std::array<double, 3>& squares) const {
    // The sine is the area over the product of the two longer edges.
    constexpr double rounding = 1.0 + 1e-12;
    return normal.squaredNorm() * std::min({squares[0], squares[1], squares[2]}) <=
           rounding * sine_of_sliver_angle_ * sine_of_sliver_angle_ * squares[0] * squares[1] * squares[2];
  }

  /// \param sine sine_of_smallest_angle().
  bool is_sliver(const Triangle& triangle, double sine) const;

 private:
  bool is_folded_back(std::uint32_t a, std::uint32_t b, const Vec3d& normal, const Vec3d& other_normal,
                      double dot) const;

  const BirthRecords& births_;
  double split_length_;
  double split_growth_;
  double collapse_length_;
  double collapse_shrinkage_;
  double remeshed_length_;
  double squared_longest_short_edge_;  // No edge of this length is short, whatever its birth [m²].
  double fold_angle_;
  double cosine_of_fold_angle_;
  double sine_of_sliver_angle_;
};

}  // namespace particle_surface_tracker
