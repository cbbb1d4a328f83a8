#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <openvdb/Types.h>

#include "particle_surface_tracker/core/implicit_surface.h"
#include "stages/nodes/leaf_index.h"
#include "stages/nodes/leaf_masks.h"

namespace particle_surface_tracker {

/// Which component of φ = 0 is nearest, in the cells around every place where two of them are near each other.
class ComponentLabels {
 public:
  /// Where no component but the largest is near, or none at all.
  static constexpr std::int32_t kFar = -1;

  explicit ComponentLabels(const ImplicitSurface& surface);

  /// Whether φ = 0 is of one piece, or empty.
  bool is_of_one_piece() const { return leaves_.empty(); }

  /// Whether a component is so small that it may come and go with the way its few particles lie to the lattice.
  bool is_speck(std::int32_t number) const { return is_speck_[static_cast<std::size_t>(number)]; }

  /// The number of its component for every position: 0 for the largest, the others count from 1; or kFar.
  std::vector<std::int32_t> of(const std::vector<Vec3f>& positions) const;

 private:
  using Leaf = std::array<std::int32_t, 512>;  // of 8³ cells, z fastest

  void add(const openvdb::Coord& origin, const LeafWords& cells, std::int32_t number);

  double dx_;
  std::vector<bool> is_speck_;
  std::vector<Leaf> leaves_;
  LeafIndex index_{64};
};

}  // namespace particle_surface_tracker
