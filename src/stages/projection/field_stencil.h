#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/signed_distance_field.h"
#include "stages/nodes/leaf_index.h"

namespace particle_surface_tracker {

/// The leaves of φ by their origin; may be read by many threads at a time.
class FieldLeaves {
 public:
  /// \param field must outlive this.
  explicit FieldLeaves(const SignedDistanceField& field);

  /// The 512 values of a leaf; SignedDistanceField::absent where it is not there.
  const float* values(const openvdb::Coord& origin) const {
    const std::uint32_t number = index_.find(origin);
    return number == LeafIndex::none ? absent_.data() : values_[number];
  }

 private:
  LeafIndex index_;
  std::vector<const float*> values_;
  std::array<float, 512> absent_;
};

/// Reads the 4 × 4 × 4 nodes around cells of φ.
class FieldStencil {
 public:
  /// \param leaves must outlive this.
  explicit FieldStencil(const FieldLeaves& leaves) : leaves_(leaves) {}

  /// Writes the 64 nodes around `cell`, its corner at lower − 1 first, z fastest, to nodes[0], nodes[stride], …; those
  /// that are not there as SignedDistanceField::absent.
  void load(const openvdb::Coord& cell, float* nodes, std::size_t stride) const;

 private:
  const FieldLeaves& leaves_;
};

}  // namespace particle_surface_tracker
