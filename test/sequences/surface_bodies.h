#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/types.h"
#include "sequences/solid_judge.h"

namespace particle_surface_tracker::test {

/// The bodies of liquid that a closed surface bounds: each is a component of positive volume (a solid) together with
/// the components of negative volume (cavities) that lie in it and in no smaller solid. Components of a surface that
/// crosses itself are judged by the majority of nine of their vertices.
class SurfaceBodies {
 public:
  static constexpr std::uint32_t kNone = 0xffffffffU;

  /// \param triangles of a closed, oriented surface.
  SurfaceBodies(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles);

  /// Number of bodies, numbered in the order of the lowest vertex of their solids.
  std::size_t size() const { return body_count_; }
  std::size_t cavities() const { return cavities_; }

  /// Solids where other components wind around them already.
  std::size_t nested_solids() const { return nested_solids_; }
  /// Components of negative or no volume that are not inside exactly one solid.
  std::size_t misplaced_cavities() const { return misplaced_cavities_; }

  /// The bodies that a point is in, in increasing order: several where bodies overlap; none in a cavity, but the body
  /// around a droplet's cavity never has the droplet's points. A point in none belongs to that of the nearest triangle,
  /// if that is within `reach` [m].
  std::vector<std::uint32_t> bodies_of(const Vec3f& point, double reach) const;

  /// The same of many points, in parallel.
  std::vector<std::vector<std::uint32_t>> bodies_of(const std::vector<Vec3f>& points, double reach) const;

  /// A vertex of the solid of a body.
  const Vec3f& vertex_of(std::uint32_t body) const { return body_vertices_[body]; }

  const SolidJudge& judge() const { return judge_; }

 private:
  struct Component;

  void find_components(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles,
                       std::vector<Component>& components);
  void place_components(const std::vector<Vec3f>& positions, std::vector<Component>& components);

  SolidJudge judge_;
  std::vector<std::uint32_t> component_of_triangle_;
  std::vector<std::uint32_t> body_of_component_;  ///< kNone for those that belong to no body.
  std::vector<Vec3f> body_vertices_;
  std::size_t body_count_ = 0;
  std::size_t cavities_ = 0;
  std::size_t nested_solids_ = 0;
  std::size_t misplaced_cavities_ = 0;
};

}  // namespace particle_surface_tracker::test
