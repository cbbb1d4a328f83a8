#pragma once

#include <array>
#include <cstddef>

#include <openvdb/openvdb.h>

#include "particle_surface_tracker/core/signed_distance_field.h"

namespace particle_surface_tracker {

/// Reads the 4 × 4 × 4 nodes around cells of φ. One object per thread.
class FieldStencil {
 public:
  explicit FieldStencil(const SignedDistanceField& field);

  /// Writes the 64 nodes around `cell`, its corner at lower − 1 first, z fastest, to nodes[0], nodes[stride], …; those
  /// that are not there as SignedDistanceField::absent.
  void load(const openvdb::Coord& cell, float* nodes, std::size_t stride);

 private:
  struct Slot {
    openvdb::Coord origin;
    const float* values;
  };

  const float* leaf_values(const openvdb::Coord& origin);

  openvdb::FloatGrid::ConstAccessor accessor_;
  std::array<Slot, 64> leaves_;  // the leaves met last, by a hash of their origin
};

}  // namespace particle_surface_tracker
